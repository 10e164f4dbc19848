#pragma once
#include <filesystem>
#include <string>
#include <vector>

struct CommonOptions;

struct StabilityOptions {
    std::vector<std::string> variants, cases;  ///< empty: all
    bool has_all_stages = false, is_of_precision = false;
    std::filesystem::path table, out, figure;  ///< table "": ssrlab's own; figure "": none
};

/// `ssrlab stability --precision`. Returns the exit code, 0.
int precision_command(const StabilityOptions& options, const CommonOptions& common);
/// The figure of a stability.csv: PDF, PNG or SVG by its name. The exit code: 0, 2 or 3.
int stability_figure(const std::filesystem::path& csv, const std::filesystem::path& figure);
