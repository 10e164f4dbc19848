#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/ended_point.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

struct StudyAnswers;  // answers.h, which cells must not depend on

struct RunSettings {
    std::filesystem::path out;                       ///< results folder; a stopped study continues in it
    std::string device;                              ///< name of the device, as Device takes it
    std::filesystem::path cache;                     ///< of references
    std::vector<std::filesystem::path> search_path;  ///< of scenes
    bool keep_all = false;
    bool replaces = false;           ///< takes over a folder with the results of another study
    bool prunes = false;             ///< removes files that earlier versions of the study left
    bool takes_times_here = false;   ///< takes times again that another machine took
    bool takes_times_again = false;  ///< takes disturbed times again; keeps the less disturbed
    /// Studies that are estimated to take more seconds are named before they start ...
    double names_after = 3600;
    /// ... and start if this says so; null: they start.
    std::function<bool()> confirm = {};
    double report_after = 10;  ///< seconds from the start to the first tables and report, and least time between them
    /// Makes the page of a results folder and returns its first answers; null: tables only.
    std::function<StudyAnswers(const std::filesystem::path& results)> write_report = {};
    std::vector<std::string> cells;  ///< terms of CellSelection; empty: all cells
    std::vector<EndedPoint> ended;   ///< points that are left out, which the end of the run says
};

/// Runs a study and fills the results folder (experiments/docs/results_folder.md). Tables and report can be read while
/// it runs. They are written ten seconds after the start, then as often as a small share of the time allows, and at the
/// end. A run of a part of the cells writes the cells alone: merge_study() makes the tables once all cells are there.
/// Fails with Error, before anything is written, if `confirm` says no.
/// Fails with MachineError at the end if points were left out, and at once if the baseline is one of them.
void run_study(const Config& config, const RunSettings& settings);

/// A shell command for this study that works in any folder: `command` is run, merge or plan. It has absolute paths of
/// program, config and results folder, and the settings that the user gave.
std::string command_line(const std::string& command, const Config& config, const RunSettings& settings);
