#pragma once
#include <filesystem>

struct DiffOptions {
    std::filesystem::path before, after, csv, page;
    bool judges_times = false, shows_all = false;
    double margin = 0;  ///< 0: that of the new study
};

/// Prints what changed. Returns the exit code: 0, or 1 if a number changed.
int diff_command(const DiffOptions& options);
