#include "experiments/gpu_costs/chips/chip_rates.h"

#include "core/list_text.h"
#include "experiments/gpu_costs/chips/chip_compiler.h"

#include <cctype>
#include <map>
#include <ranges>

namespace {

ChipRates of_product(ChipRates generation, const char* product, unsigned units, double gigahertz, double memory,
                     double cache, double pixels) {
    generation.product = product, generation.units = units, generation.gigahertz = gigahertz;
    generation.memory_gigabytes = memory, generation.cache_bytes = cache, generation.pixels = pixels;
    return generation;
}

const std::map<std::string, ChipRates>& all_rates() {
    static const std::map<std::string, ChipRates> known = [] {
        const ChipRates rdna{.simds = 2,
                             .simd_lanes = 32,
                             .scalar = 2,
                             .filtered_bytes = 8,
                             .loaded_lanes = 32,
                             .loaded_bytes = 128,
                             .stored_lanes = 16,
                             .buffer_lanes = 32},
            gcn{.simds = 4,
                .simd_lanes = 16,
                .scalar = 1,
                .filtered_bytes = 4,
                .loaded_lanes = 4,
                .loaded_bytes = 33,
                .stored_lanes = 4,
                .buffer_lanes = 16,
                .waits_for_stores = true};
        std::map<std::string, ChipRates> rates = {
            {"navi21", of_product(rdna, "Radeon RX 6800 XT", 72, 2.25, 512, 1024, 128)},
            {"gfx1100", of_product(rdna, "Radeon RX 7900 XTX", 96, 2.5, 960, 1536, 192)},
            {"gfx1201", of_product(rdna, "Radeon RX 9070 XT", 64, 2.97, 640, 1024, 128)},
            {"vega10", of_product(gcn, "Radeon RX Vega 64", 64, 1.546, 483.8, 1024, 64)},
            {"polaris10", of_product(gcn, "Radeon RX 480", 36, 1.266, 256, 512, 32)},
        };
        ChipRates &navi21 = rates.at("navi21"), &gfx1100 = rates.at("gfx1100"), &gfx1201 = rates.at("gfx1201");
        navi21.last_megabytes = 128, navi21.last_gigabytes = 2000;
        gfx1100.last_megabytes = 96, gfx1100.last_gigabytes = 5300;
        gfx1201.last_megabytes = 64, gfx1201.last_gigabytes = 2000;
        gfx1100.slow_double = gfx1201.slow_double = 32;
        return rates;
    }();
    return known;
}

}  // namespace

std::optional<ChipRates> chip_rates(const std::string& chip) {
    auto found = all_rates().find(chip);
    if (found == all_rates().end()) found = all_rates().find(other_name(chip));
    return found == all_rates().end() ? std::nullopt : std::optional(found->second);
}

std::string chip_named(const std::string& text) {
    const auto plain = [](const std::string& name) {
        std::string letters;
        for (const char c : name)
            if (std::isalnum(static_cast<unsigned char>(c)))
                letters += char(std::tolower(static_cast<unsigned char>(c)));
        for (const std::string maker : {"amd", "radeon", "rx"})
            if (letters.starts_with(maker)) letters.erase(0, maker.size());
        return letters;
    };
    for (const auto& [chip, rates] : all_rates())
        if (plain(rates.product) == plain(text)) return chip;
    return text;
}

std::vector<std::string> chips_with_rates() { return names_of(std::views::keys(all_rates())); }
