#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// A family of scenes without end, each drawn from a stated distribution by its number: `room:17` (scenes/rooms.md).
struct SceneFamily {
    std::string name, about;
};
const std::vector<SceneFamily>& scene_families();

inline constexpr unsigned largest_scene_number = 999'999;

/// Whether the name is "<a family's name>:<anything>".
bool is_of_family(const std::string& name);

/// Whether it is "<a family's name>:*", which stands for several in a row.
bool names_several(const std::string& name);

/// "room:5", "room:6", "room:7" of "room:*", 5 and 3. Fails with Error where they go beyond the last number.
std::vector<std::string> scenes_in_a_row(const std::string& name, unsigned first, unsigned count);

/// The scene.json of a scene of a family. The first use makes it, by `scenes/generate.py`, in the folder `scenes` of
/// the cache (default_cache_folder()), below the hash of the generator's sources: after a change of these no old scene
/// is found. It appears whole or not at all, with a hash of its files; one that was cut or changed since is made again.
/// Fails with Error if the name is no scene's, and with MachineError if the folder cannot be written or the generator
/// does not end well.
std::filesystem::path scene_file_of_family(const std::string& name);
