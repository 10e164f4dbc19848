#pragma once
#include "variants/common/technique.h"

#include <filesystem>
#include <functional>
#include <map>

/// Named values of some parameters of a technique.
struct Preset {
    std::string name, meaning;
    nlohmann::json parameters;
};

/// The API whose limits a technique obeys, so that it runs there. Each of the parameters' values in `lifted_by` needs
/// more than the API has, and lifts the limits.
struct TechniqueLimits {
    Limits api = Limits::none;
    nlohmann::json lifted_by = nlohmann::json::object();
};

/// The folder, as read, of a technique that technique.json declares (variants/declared).
struct TechniqueFolder {
    std::filesystem::path path;
    bool is_ssrlabs = false;  ///< under variants/, not outside ssrlab
    std::map<std::string, std::string>
        files;                         ///< content of the files that the technique uses, by their paths in the folder
    std::vector<std::string> sources;  ///< ssrlab's own shaders that it names or includes, by their paths from the root
    std::string content_hash;          ///< of all that can change a pixel, so not of texts for readers or presets
};

/// One row of the table of techniques.
struct TechniqueEntry {
    std::string name, title, source, description;
    std::vector<Preset> presets;
    TechniqueLimits limits{};
    std::function<std::unique_ptr<Technique>()> create;
    std::shared_ptr<const TechniqueFolder> folder{};  ///< if a folder declares the technique

    /// Whether the technique is one of variants/.
    bool is_ssrlabs() const { return !folder || folder->is_ssrlabs; }
};
