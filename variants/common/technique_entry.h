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

/// The API whose limits a technique obeys, so that it runs there. `lifted_by` holds values of parameters; each of them
/// asks for more than the API has and lifts the limits.
struct TechniqueLimits {
    Limits api = Limits::none;
    nlohmann::json lifted_by = nlohmann::json::object();
};

/// The folder of a technique that its technique.json declares (variants/declared), as it was read.
struct TechniqueFolder {
    std::filesystem::path path;
    bool is_ssrlabs = false;                   ///< one of variants/, else somebody's
    std::map<std::string, std::string> files;  ///< content of those that take part, by their paths in the folder
    std::vector<std::string> sources;  ///< ssrlab's own shaders that it names or includes, by their paths from the root
    std::string content_hash;          ///< of what can change a pixel: neither of texts for readers nor of presets
};

/// One row of the table of techniques.
struct TechniqueEntry {
    std::string name, title, source, description;
    std::vector<Preset> presets;
    TechniqueLimits limits{};
    std::function<std::unique_ptr<Technique>()> create;
    std::shared_ptr<const TechniqueFolder> folder{};  ///< of one that a folder declares; else none

    /// Whether it is one of variants/, not of somebody's own folder.
    bool is_ssrlabs() const { return !folder || folder->is_ssrlabs; }
};
