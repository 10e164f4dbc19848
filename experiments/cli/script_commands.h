#pragma once
#include <filesystem>
#include <string>
#include <vector>

// Commands that are Python scripts, which parse the arguments. Each returns the exit code: 0, 2 or 3.

int figures_command(const std::vector<std::string>& arguments);

/// Draws the figure of a stability.csv: PDF, PNG or SVG by its file name.
int stability_figure(const std::filesystem::path& csv, const std::filesystem::path& figure);
