#pragma once
#include "experiments/study/config/config.h"

#include <nlohmann/json.hpp>
#include <string>

/// The comments that begin exported shaders: pass, source, licence, and the ssrlab that wrote it.
class FileHeads {
public:
    /// Reads the repository's LICENSE, and what this program was built from.
    FileHeads();

    /// `step`: of passes.json, with "stage", "resources" and "targets".
    std::string head_of_pass(const PointConfig& point, const nlohmann::json& step) const;
    std::string head_of_vertex_stage() const;

    const std::string& license() const { return license_; }  ///< the whole text
    std::string license_name() const;                        ///< SPDX's: "MIT"

private:
    std::string lines_of_all() const;

    std::string license_;
    nlohmann::json build_;
};
