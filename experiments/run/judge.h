#pragma once
#include "experiments/evaluation/judgement.h"
#include "experiments/run/run.h"

#include <filesystem>
#include <optional>
#include <string>

struct JudgeSettings {
    std::filesystem::path frames;              ///< a folder of another program's images (ExternalImages)
    std::filesystem::path against;             ///< another of the same views, by the same engine; "": none
    std::string scene;                         ///< in place of the names of the views; "": these are found by them
    std::filesystem::path capture, reference;  ///< in place of a scene; "": none
    unsigned samples = 256;                    ///< of the references, per pixel
    RunSettings run;                           ///< its folder gets the study and the page
};

/// What is said of a view without another to compare it with.
struct ViewError {
    std::string shot;
    std::optional<double> error, low, high;  ///< PrimaryComparisons, 95 %
    std::optional<double> ratio_to_none;     ///< over that of no reflections
};

struct JudgedFrames {
    std::vector<ViewError> errors;
    std::optional<Judgement> against;  ///< if there are frames to compare with
};

/// The error of a renderer's frames in all views that their folder holds, by a study in settings.run.out whose report
/// has masks, maps and numbers. Fails with Error where a view cannot be found or compared.
JudgedFrames judge_frames(const JudgeSettings& settings);
