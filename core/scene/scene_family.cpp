#include "core/scene/scene_family.h"

#include "core/cache_folder.h"
#include "core/child_process.h"
#include "core/error.h"
#include "core/files.h"
#include "core/leftovers.h"
#include "core/near_miss.h"
#include "core/own_files.h"
#include "core/scene/unknown_scene.h"

#include <algorithm>
#include <charconv>
#include <mutex>
#include <set>

namespace fs = std::filesystem;

namespace {

fs::path scenes_folder() { return own_files() / "scenes"; }

/// Of all sources that decide what the generator writes.
std::string hash_of_generator() {
    std::vector<fs::path> sources = {scenes_folder() / "generate.py"};
    for (const auto& entry : fs::recursive_directory_iterator(scenes_folder() / "generator"))
        if (entry.path().extension() == ".py") sources.push_back(entry.path());
    std::ranges::sort(sources);
    ContentHash hash;
    for (const fs::path& source : sources)
        hash.add(source.lexically_relative(scenes_folder()).string()), hash.add(read_text(source));
    return hash.hex();
}

unsigned number_of(const std::string& name) {
    const std::string digits = name.substr(name.find(':') + 1);
    unsigned number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size() || number > largest_scene_number)
        throw UnknownScene(message_text("no scene is called '", shortened(name),
                                        "': after the colon stands a whole number from 0 to ", largest_scene_number,
                                        ", as in '", name.substr(0, name.find(':')), ":17'"));
    return number;
}

constexpr const char* hash_file = "content.hash";

/// Of the names and bytes of all files of a scene's folder.
std::string hash_of_scene(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (!entry.is_directory() && entry.path().filename() != hash_file) files.push_back(entry.path());
    std::ranges::sort(files);
    ContentHash hash;
    for (const fs::path& file : files) hash.add(file.lexically_relative(folder).string()), hash.add(read_text(file));
    return hash.hex();
}

/// Whether the folder has the scene as it was made: not cut, and no byte changed.
bool is_whole(const fs::path& scene) {
    try {
        return fs::exists(scene / "scene.json") && read_text(scene / hash_file) == hash_of_scene(scene);
    } catch (const Error&) {  // a file is missing, or no regular file
        return false;
    } catch (const fs::filesystem_error&) {
        return false;
    }
}

/// is_whole(), which hashes a scene once in a process.
bool is_known_as_whole(const fs::path& scene) {
    static std::set<fs::path> known;
    static std::mutex mutex;
    {
        const std::lock_guard lock(mutex);
        if (known.contains(scene) && fs::exists(scene / "scene.json")) return true;
    }
    if (!is_whole(scene)) return false;
    const std::lock_guard lock(mutex);
    known.insert(scene);
    return true;
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
    if (is_known_as_whole(folder / scene)) return folder / scene / "scene.json";

    // Made under another name, and renamed when it is whole: who is interrupted leaves nothing that is taken for a
    // scene.
    remove_leftovers(folder);
    const fs::path beside = unfinished_path(folder / scene);
    std::error_code error;
    fs::create_directories(beside, error);
    if (error)
        fail_machine("cannot create the cache folder ", beside.string(), ": ", error.message(),
                     "; choose another with --cache or SSRLAB_CACHE");
    const int code = run_program({SSRLAB_PYTHON, "-B", (scenes_folder() / "generate.py").string(), "--out",
                                  beside.string(), family + ":" + std::to_string(number)});
    std::error_code ignored;
    if (code == 0 && fs::exists(beside / scene / "scene.json")) {
        write_text(beside / scene / hash_file, hash_of_scene(beside / scene));
        // Another process may have made it in the meantime. What is damaged gives way.
        if (!is_whole(folder / scene)) fs::rename(folder / scene, beside / "damaged", ignored);
        fs::rename(beside / scene, folder / scene, error);
    }
    const bool is_there = is_whole(folder / scene);
    fs::remove_all(beside, ignored);
    if (!is_there)
        fail_machine("cannot make the scene '", name, "' in ", folder.string(), ": ",
                     code ? "scenes/generate.py ended with code " + std::to_string(code) + " and said why above"
                          : error.message());
    return folder / scene / "scene.json";
}
