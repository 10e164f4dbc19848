#pragma once
#include "core/json.h"
#include "core/parameters.h"

#include <filesystem>

/// A parameter that a file declares. `place` begins messages about it.
struct DeclaredParameter {
    Parameter parameter;
    std::string place;
};

/// Reads the parameters of a file under variants/ or in a technique's folder, and of the blocks that it includes.
class ParameterReader {
public:
    /// `folder`: of a technique outside ssrlab, where included blocks are looked for first; "": none.
    explicit ParameterReader(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}

    /// Reads `parameters` of `owner`. Names get `prefix` and a dot in front; "{prefix}" in texts stands for it. Fails
    /// with Error, which names the place, on an invalid parameter.
    std::vector<DeclaredParameter> read(JsonObject& owner, const std::string& prefix = "");

    std::vector<std::string> of_folder,
        of_ssrlab;  ///< included files, by their paths below the folder or ssrlab's root

private:
    std::vector<DeclaredParameter> included(JsonObject include, const std::string& prefix);

    std::filesystem::path folder_;
    size_t depth_ = 0;  ///< of nested includes
};

/// Adds the parameters of a file under variants/, which is read once per process.
void add_block(ParameterSet& params, const std::string& file);
