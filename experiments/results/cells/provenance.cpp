#include "experiments/results/cells/provenance.h"

#include "experiments/results/cells/host_info.h"

#include <algorithm>

namespace {

constexpr const char* maker_keys[] = {"ssrlab", "device", "host"};

}  // namespace

nlohmann::json maker_of_cells(const Device& device) {
    const DeviceInfo& d = device.info();
    return {{"ssrlab", build_info()},
            {"device",
             {{"name", d.name}, {"driver", d.driver}, {"api", d.api}, {"type", d.type}, {"memory_mib", d.memory_mib}}},
            {"host", host_info()}};
}

nlohmann::json cell_provenance(const nlohmann::json& maker, const std::string& what, const std::string& started) {
    nlohmann::json provenance = maker;
    provenance["what"] = what, provenance["started"] = started, provenance["finished"] = time_stamp();
    return provenance;
}

nlohmann::json provenance_entries(std::span<const Cell> cells) {
    nlohmann::json entries = nlohmann::json::array();
    for (const Cell& cell : cells) {
        const nlohmann::json& made = cell.provenance;
        if (!made.is_object()) continue;
        const auto is_same_maker = [&](const nlohmann::json& entry) {
            return std::ranges::all_of(maker_keys, [&](const char* key) { return entry[key] == made.at(key); });
        };
        auto entry = std::ranges::find_if(entries, is_same_maker);
        if (entry == entries.end()) {
            entries.push_back({{"started", made.at("started")}, {"finished", made.at("finished")}});
            entry = std::prev(entries.end());
            for (const char* key : maker_keys) (*entry)[key] = made.at(key);
        }
        // Time stamps of one zone and format are ordered as texts are.
        (*entry)["started"] = std::min((*entry)["started"], made.at("started"));
        (*entry)["finished"] = std::max((*entry)["finished"], made.at("finished"));
        (*entry)["cells"].push_back({{"cell", cell.name},
                                     {"what", made.at("what")},
                                     {"started", made.at("started")},
                                     {"finished", made.at("finished")}});
    }
    return entries;
}
