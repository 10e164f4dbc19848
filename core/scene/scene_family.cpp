#include "core/scene/scene_family.h"

#include "core/cache_folder.h"
#include "core/child_process.h"
#include "core/error.h"
#include "core/files.h"
#include "core/near_miss.h"

#include <unistd.h>
#include <algorithm>
#include <charconv>

namespace fs = std::filesystem;

namespace {

const fs::path scenes_folder = fs::path(SSRLAB_SOURCE_DIR) / "scenes";

/// Of all sources that decide what the generator writes.
std::string hash_of_generator() {
    std::vector<fs::path> sources = {scenes_folder / "generate.py"};
    for (const auto& entry : fs::recursive_directory_iterator(scenes_folder / "generator"))
        if (entry.path().extension() == ".py") sources.push_back(entry.path());
    std::ranges::sort(sources);
    ContentHash hash;
    for (const fs::path& source : sources)
        hash.add(source.lexically_relative(scenes_folder).string()), hash.add(read_text(source));
    return hash.hex();
}

unsigned number_of(const std::string& name) {
    const std::string digits = name.substr(name.find(':') + 1);
    unsigned number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size() || number > largest_scene_number)
        fail("no scene is called '", shortened(name), "': after the colon stands a whole number from 0 to ",
             largest_scene_number, ", as in '", name.substr(0, name.find(':')), ":17'");
    return number;
}

}  // namespace

const std::vector<SceneFamily>& scene_families() {
    static const std::vector<SceneFamily> families = {
        {"room", "Furnished rooms, drawn by their number: what techniques do in interiors that no one made for them."},
        {"street", "Streets with facades, wet ground and cars, drawn by their number: the same outdoors."}};
    return families;
}

bool is_of_family(const std::string& name) {
    return std::ranges::any_of(scene_families(),
                               [&](const SceneFamily& family) { return name.starts_with(family.name + ":"); });
}

bool names_several(const std::string& name) { return is_of_family(name) && name.ends_with(":*"); }

std::vector<std::string> scenes_in_a_row(const std::string& name, unsigned first, unsigned count) {
    if (uint64_t(first) + count > uint64_t(largest_scene_number) + 1)
        fail("'", name, "': a count of ", count, " from number ", first, " on goes beyond ", largest_scene_number,
             ", the last");
    std::vector<std::string> names;
    for (unsigned i = 0; i < count; ++i) names.push_back(name.substr(0, name.size() - 1) + std::to_string(first + i));
    return names;
}

fs::path scene_file_of_family(const std::string& name) {
    const unsigned number = number_of(name);
    const std::string family = name.substr(0, name.find(':'));
    static const std::string hash = hash_of_generator();
    const fs::path folder = default_cache_folder() / "scenes" / hash, scene = family + "_" + std::to_string(number);
    if (fs::exists(folder / scene / "scene.json")) return folder / scene / "scene.json";

    // Made under another name, and renamed when it is whole: who is interrupted leaves nothing that is taken for a
    // scene.
    const fs::path beside = folder / (scene.string() + ".partial-" + std::to_string(getpid()));
    std::error_code error;
    fs::create_directories(beside, error);
    if (error) fail_machine("cannot create the cache folder ", beside.string(), ": ", error.message());
    const int code = run_program({SSRLAB_PYTHON, "-B", (scenes_folder / "generate.py").string(), "--out",
                                  beside.string(), family + ":" + std::to_string(number)});
    if (code == 0 && fs::exists(beside / scene / "scene.json")) fs::rename(beside / scene, folder / scene, error);
    const bool is_there = fs::exists(folder / scene / "scene.json");  // by us, or by another process in the meantime
    std::error_code ignored;
    fs::remove_all(beside, ignored);
    if (!is_there)
        fail_machine("cannot make the scene '", name, "' in ", folder.string(), ": ",
                     code ? "scenes/generate.py ended with code " + std::to_string(code) + " and said why above"
                          : error.message());
    return folder / scene / "scene.json";
}
