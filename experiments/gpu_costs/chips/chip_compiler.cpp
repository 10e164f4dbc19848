#include "experiments/gpu_costs/chips/chip_compiler.h"

#include "core/child_process.h"
#include "core/error.h"
#include "core/files.h"
#include "core/list_text.h"
#include "core/memory_file.h"
#include "core/near_miss.h"
#include "core/own_files.h"

#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <thread>

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

const char* const no_radv =
    "there is no radv, Mesa's Vulkan driver of AMD's GPUs, which compiles without one (on Debian: apt-get install "
    "mesa-vulkan-drivers)";

// Names in src/amd/common/amd_family.c of Mesa, in lower case.
/// In Mesa 22.3.6 and in 25.0.7.
const std::vector<std::string> lasting = {
    "tahiti", "pitcairn", "verde",   "oland",  "hainan",  "bonaire",   "kabini",    "kaveri",    "hawaii",
    "tonga",  "iceland",  "carrizo", "fiji",   "stoney",  "polaris10", "polaris11", "polaris12", "vegam",
    "vega10", "vega12",   "vega20",  "raven",  "raven2",  "renoir",    "navi10",    "navi12",    "navi14",
    "navi21", "navi22",   "navi23",  "navi24", "vangogh", "rembrandt"};
/// In Mesa 22.3.6, and what 25.0.7 calls them.
const std::vector<std::pair<std::string, std::string>> renamed = {
    {"arcturus", "mi100"}, {"aldebaran", "mi200"}, {"gfx1036", "raphael_mendocino"}, {"gfx1100", "navi31"},
    {"gfx1101", "navi32"}, {"gfx1102", "navi33"},  {"gfx1103_r1", "phoenix"},        {"gfx1103_r2", "phoenix2"}};
/// In Mesa 25.0.7.
const std::vector<std::string> newer = {"gfx940", "gfx1150", "gfx1151", "gfx1152", "gfx1153", "gfx1200", "gfx1201"};

std::vector<std::string> all_names() {
    std::vector<std::string> names = lasting;
    for (const auto& [old_name, new_name] : renamed) names.insert(names.end(), {old_name, new_name});
    names.insert(names.end(), newer.begin(), newer.end());
    return names;
}

/// Without a new result. Passes take seconds at most, on a machine at rest.
constexpr std::chrono::seconds patience_with_compiler(120);

struct Answer {
    std::vector<json> lines;  ///< as far as the compiler got
    std::string end;          ///< how it ended, if not well
    bool was_aborted = false;
};

/// The lines that the program in main.cpp writes.
Answer ask(const std::string& chip, const fs::path& radv, const std::string& recipes, bool has_assembly) {
    const MemoryFile in, out;
    std::ofstream(in.path(), std::ios::binary) << recipes;
    std::vector<std::string> command = {(built_files() / "chip_compiler").string(), chip, in.path(), out.path()};
    if (has_assembly) command.push_back("--assembly");
    if (!radv.empty()) command.insert(command.end(), {"--driver", radv.string()});
    Answer answer;
    const Patience patience{patience_with_compiler, [&] { return size_t(fs::file_size(out.path())); }};
    try {
        if (const int code = run_program(command, &patience); code != 0)
            answer.end = "exit code " + std::to_string(code);
    } catch (const MachineError& e) {
        answer.end = e.what();
        answer.was_aborted = answer.end.ends_with("signal " + std::to_string(SIGABRT));
    }
    std::ifstream lines(out.path());
    for (std::string line; std::getline(lines, line);) {
        const json value = json::parse(line, nullptr, false);
        if (value.is_discarded()) continue;  // the compiler ended while it was written
        if (value.contains("unusable"))
            fail("Mesa's driver of --mesa or SSRLAB_MESA cannot be used: ", value["unusable"].get<std::string>(),
                 "; unpack what is missing into the same folder (`dpkg -x PACKAGE.deb FOLDER`), or take a package that "
                 "was built for this system");
        if (value.contains("error")) fail_machine("cannot compile for ", chip, ": ", value["error"].get<std::string>());
        answer.lines.push_back(value);
    }
    return answer;
}

/// The chip, if radv has one of that name; MachineError without radv.
std::optional<Chip> ask_for_chip(const std::string& name, const fs::path& radv) {
    const Answer answer = ask(name, radv, bytes_of(std::vector<PipelineRecipe>{}), false);
    if (answer.lines.empty()) {
        if (answer.was_aborted) return {};  // as radv does on a name that it does not know
        fail_machine("cannot compile for ", name, ": ", answer.end);
    }
    const json& about = answer.lines.front();
    if (about.contains("refusal")) fail_machine(no_radv);
    return Chip{
        .name = name, .name_in_driver = name, .device = about.at("device"), .driver = about.at("driver"), .radv = radv};
}

CompiledShader shader_of(const json& j) {
    const json& statistics = j.at("statistics");
    const auto find = [&](const char* name) -> std::optional<double> {
        const auto found = statistics.find(name);
        return found != statistics.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
    };
    CompiledShader shader;
    // VkShaderStageFlagBits
    const auto stages = j.at("stages").get<unsigned>();
    shader.stage = stages & 0x20 ? "compute" : stages & 0x10 ? "fragment" : "vertex";
    shader.lanes = j.at("lanes");
    for (const CompilerNumber& number : compiler_numbers) shader.*number.member = find(number.statistic);
    shader.waves = find("Subgroups per SIMD");
    if (const auto hash = statistics.find("Hash"); hash != statistics.end() && hash->is_number()) {
        char text[17];
        std::snprintf(text, sizeof text, "%08llx", hash->get<unsigned long long>());  // no double holds all 64 bits
        shader.hash = text;
    }
    if (const auto assembly = j.at("texts").find("Assembly"); assembly != j.at("texts").end())
        shader.assembly = assembly->get<std::string>();
    return shader;
}

CompiledPipeline pipeline_of(const json& j) {
    if (j.contains("refusal")) return {.shaders = {}, .refusal = j.at("refusal")};
    CompiledPipeline pipeline;
    for (const json& shader : j.at("shaders")) pipeline.shaders.push_back(shader_of(shader));
    return pipeline;
}

/// Those of `recipes` whose places are given, one after the other; a compiler that ends early is started again behind
/// the pipeline that ended it.
void compile_some(const Chip& chip, const std::vector<PipelineRecipe>& recipes, std::vector<size_t> places,
                  bool has_assembly, std::vector<json>& results) {
    while (!places.empty()) {
        std::vector<PipelineRecipe> some;
        for (const size_t place : places) some.push_back(recipes[place]);
        const Answer answer = ask(chip.name_in_driver, chip.radv, bytes_of(some), has_assembly);
        const size_t known = answer.lines.empty() ? 0 : std::min(answer.lines.size() - 1, places.size());
        for (size_t i = 0; i < known; ++i) results[places[i]] = answer.lines[i + 1];
        if (known == places.size()) return;
        results[places[known]] = {{"refusal", "radv's compiler ended: " + answer.end}};
        places.erase(places.begin(), places.begin() + long(known) + 1);
    }
}

fs::path cached_file(const fs::path& cache, const Chip& chip, const PipelineRecipe& recipe, bool has_assembly) {
    constexpr unsigned version =
        1;  // to be raised when make_pipeline(), the chip's device or numbers of a recipe change
    ContentHash hash;
    hash.add(version), hash.add(bytes_of({recipe})), hash.add(chip.name_in_driver), hash.add(chip.driver);
    hash.add(int(has_assembly));
    return cache / "chips" / (hash.hex() + ".json");
}

/// Null if there is none, or one that was not written whole.
json read_cached(const fs::path& file) {
    if (!fs::exists(file)) return {};
    json value = json::parse(read_text(file), nullptr, false);
    try {
        return pipeline_of(value).shaders.empty() ? json() : value;
    } catch (const json::exception&) {
        return {};
    }
}

}  // namespace

std::string other_name(const std::string& chip) {
    for (const auto& [old_name, new_name] : renamed) {
        if (chip == old_name) return new_name;
        if (chip == new_name) return old_name;
    }
    return "";
}

Chip find_chip(const std::string& asked, const fs::path& mesa) {
    const fs::path radv = radv_in(mesa);
    std::string name = asked;
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if (const std::optional<Chip> chip = ask_for_chip(name, radv)) return *chip;
    if (const std::string other = other_name(name); !other.empty())
        if (std::optional<Chip> chip = ask_for_chip(other, radv)) {
            chip->name = name;
            return *chip;
        }
    const std::string driver = ask_for_chip(lasting.front(), radv).value_or(Chip{.driver = "radv"}).driver;
    if (std::ranges::count(newer, name))
        fail(driver, " does not know the chip '", name,
             "', which Mesa 25.0.7 compiles for: `experiments/newer_mesa.sh FOLDER` unpacks that, and --mesa FOLDER or "
             "SSRLAB_MESA=FOLDER takes it");
    fail(driver, " knows no chip '", shortened(name), "'", suggestion(name, all_names()), "; Mesa 22.3.6 compiles for ",
         lasting.front(), " to ", renamed.back().first, " and 25.0.7 also for ", listed(newer),
         " (`ssrlab list chips` shows what a driver knows)");
}

std::vector<Chip> known_chips(const fs::path& mesa) {
    const fs::path radv = radv_in(mesa);
    ask_for_chip(default_chips.front(), radv);  // throws once where there is no radv
    const std::vector<std::string> candidates = all_names();
    std::vector<std::optional<Chip>> found(candidates.size());
    std::atomic<size_t> next = 0;
    const auto work = [&] {
        for (size_t i; (i = next++) < candidates.size();) found[i] = ask_for_chip(candidates[i], radv);
    };
    std::vector<std::future<void>> workers;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
        workers.push_back(std::async(std::launch::async, work));
    for (auto& worker : workers) worker.get();
    std::vector<Chip> chips;
    for (const auto& chip : found)
        if (chip) chips.push_back(*chip);
    return chips;
}

std::vector<CompiledPipeline> compile_for_chip(const Chip& chip, const std::vector<PipelineRecipe>& recipes,
                                               const ChipCompilation& how) {
    const bool uses_cache = !how.cache.empty();
    const auto file_of = [&](size_t i) { return cached_file(how.cache, chip, recipes[i], how.has_assembly); };
    std::vector<json> results(recipes.size());
    const size_t most = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::vector<size_t>> shares(most);
    size_t missing = 0;
    for (size_t i = 0; i < recipes.size(); ++i) {
        if (uses_cache) results[i] = read_cached(file_of(i));
        if (results[i].is_null()) shares[missing++ % most].push_back(i);
    }
    std::vector<std::future<void>> workers;
    for (const auto& share : shares)
        if (!share.empty())
            workers.push_back(
                std::async(std::launch::async, [&] { compile_some(chip, recipes, share, how.has_assembly, results); }));
    for (auto& worker : workers) worker.get();

    if (uses_cache) try {
            for (const auto& share : shares)
                for (const size_t i : share)
                    if (results[i].contains("shaders")) write_text(file_of(i), results[i].dump());
        } catch (const MachineError& e) {
            if (how.notice) how.notice(std::string("what was compiled for ") + chip.name + " is not kept: " + e.what());
        }
    std::vector<CompiledPipeline> pipelines;
    for (size_t i = 0; i < recipes.size(); ++i) pipelines.push_back(pipeline_of(results[i]));
    return pipelines;
}
