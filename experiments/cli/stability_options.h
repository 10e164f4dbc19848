#pragma once
#include <filesystem>
#include <string>
#include <vector>

struct CommonOptions;

struct StabilityOptions {
    std::vector<std::string> techniques, cases;  ///< empty: all
    bool has_all_stages = false, is_of_precision = false;
    std::filesystem::path table, out, figure;  ///< table "": ssrlab's own; figure "": none
};

/// `ssrlab stability --precision`. Returns the exit code, 0.
int precision_command(const StabilityOptions& options, const CommonOptions& common);
