#pragma once
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Settings of `ssrlab watch`.
struct WatchSettings {
    std::filesystem::path folder;     ///< folder of the technique
    std::string preset;               ///< "": the technique's defaults
    std::vector<std::string> scenes;  ///< as configs name them; the first is rendered first
    std::string camera;               ///< "": each scene's first camera
    glm::uvec2 extent{480, 270};
    std::vector<unsigned> frames{0};       ///< consecutive; the last is measured
    std::string against;                   ///< NAME or NAME:PRESET, as configs name a technique; "": nothing
    unsigned samples = 256, seeds = 0;     ///< samples per pixel of the truth; seeds, 0: a study's default
    double patience = 30;                  ///< seconds without output after which rendering is ended
    std::filesystem::path out;             ///< folder of kept versions and results
    std::vector<std::string> run_options;  ///< options of `ssrlab run`: device, cache, scene path, limits

    /// The technique's name in results.
    std::string name() const { return folder.filename().string(); }
};

/// Fails with Error if `folder` is no folder, or if `out` lies inside it.
WatchSettings with_absolute_paths(WatchSettings settings);
