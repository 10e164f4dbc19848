#pragma once
#include "core/json.h"
#include "core/parameters.h"

#include <filesystem>

/// A parameter that a file declares. `place` begins messages about it.
struct DeclaredParameter {
    Parameter parameter;
    std::string place;
};

/// Parameters of a file under variants/, or of a technique's folder, and of the blocks that it includes.
class ParameterReader {
public:
    /// `folder`: of somebody's technique, in which included blocks are looked for first; "": there is none.
    explicit ParameterReader(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}

    /// `parameters` of `owner`. `prefix`: what their names begin with, before a dot; "{prefix}" in texts stands for it.
    /// Fails with Error, which names the place, on what is no sound parameter.
    std::vector<DeclaredParameter> read(JsonObject& owner, const std::string& prefix = "");

    std::vector<std::string> of_folder, of_ssrlab;  ///< files that were included, by their paths below either

private:
    std::vector<DeclaredParameter> included(JsonObject include, const std::string& prefix);

    std::filesystem::path folder_;
    size_t depth_ = 0;  ///< of includes within includes
};

/// Adds the parameters of a file under variants/, which is read once per process.
void add_block(ParameterSet& params, const std::string& file);
