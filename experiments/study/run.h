#pragma once
#include "experiments/study/config/config.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

struct StudyAnswers;  // answers.h, which cells must not depend on

struct RunSettings {
    std::filesystem::path out;                       ///< results folder; a study that was stopped continues in it
    std::string device;                              ///< as Device takes it
    std::filesystem::path cache;                     ///< of references
    std::vector<std::filesystem::path> search_path;  ///< of scenes
    bool keep_all = false;
    bool replaces = false;           ///< gives a folder with the results of another study to this one
    bool prunes = false;             ///< removes what earlier versions of the study left in the folder
    bool takes_times_here = false;   ///< in place of times that another machine took
    bool takes_times_again = false;  ///< that other programs disturbed; the less disturbed are kept
    double report_after = 10;  ///< seconds until the first tables and report of a study that runs, and between them
    /// Makes the page of a results folder and returns what the page says first; null: tables alone are made.
    std::function<StudyAnswers(const std::filesystem::path& results)> write_report = {};
    std::vector<std::string> cells;  ///< which are done, as CellSelection takes them; empty: all
};

/// Runs a study and fills the results folder (experiments/RESULTS.md). What is finished can be read while it runs:
/// tables and report are written ten seconds after the start, then as often as a small share of the time allows, and at
/// the end. Of a part of the cells nothing but these is written: merge_study() makes the tables once all are there.
void run_study(const Config& config, const RunSettings& settings);

/// `command` (run, merge, plan) on this study as a shell takes it in any folder: this program, the config and the
/// results folder by their absolute paths, and those of the settings that the command's user gave.
std::string command_line(const std::string& command, const Config& config, const RunSettings& settings);
