#pragma once
#include "experiments/study/config/config.h"

#include <filesystem>
#include <string>
#include <vector>

struct RunSettings {
    std::filesystem::path out;                       ///< results folder; a study that was stopped continues in it
    std::string device;                              ///< as Device takes it
    std::filesystem::path cache;                     ///< of references
    std::vector<std::filesystem::path> search_path;  ///< of scenes
    bool keep_all = false;
    bool replaces = false;  ///< gives a folder with the results of another study to this one
    bool prunes = false;    ///< removes what earlier versions of the study left in the folder
};

/// Runs a study and fills the results folder (experiments/RESULTS.md). Tables are written after each shot,
/// the report and the summaries at the end, and before that as far as a twentieth of the time allows.
void run_study(const Config& config, const RunSettings& settings);
