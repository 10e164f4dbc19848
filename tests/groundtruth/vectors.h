#pragma once
#include "core/json.h"

#include <cstdlib>
#include <string>

/// A golden table of the folder that SSRLAB_VECTORS names, or of the copy in the repository.
inline nlohmann::json golden_table(const std::string& name) {
    const char* folder = std::getenv("SSRLAB_VECTORS");
    return read_json(std::filesystem::path(folder ? folder : SSRLAB_SOURCE_DIR "/tests/data/vectors") / "groundtruth" /
                     (name + ".json"));
}
