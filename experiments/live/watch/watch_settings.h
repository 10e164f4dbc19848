#pragma once
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// What `ssrlab watch` was asked for.
struct WatchSettings {
    std::filesystem::path folder;     ///< of the technique
    std::string preset;               ///< "": its defaults
    std::vector<std::string> scenes;  ///< as configs name them; the first is rendered first
    std::string camera;               ///< "": each scene's first
    glm::uvec2 extent{480, 270};
    std::vector<unsigned> frames{0};       ///< in a row; the last is measured
    std::string against;                   ///< NAME or NAME:PRESET, as configs name a technique; "": nothing
    unsigned samples = 256, seeds = 0;     ///< of the truth, per pixel; of points that depend on them, 0: as studies do
    double patience = 30;                  ///< seconds without a sign of life, after which rendering is ended
    std::filesystem::path out;             ///< folder of kept versions and of all that is rendered
    std::vector<std::string> run_options;  ///< of `ssrlab run`: device, cache, scene path, limits

    /// The technique as results name it.
    std::string name() const { return folder.filename().string(); }
};
