#pragma once
#include "experiments/results/verdicts/judgement.h"
#include "experiments/study/run.h"
#include "experiments/study/view_name.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

struct JudgeSettings {
    std::filesystem::path frames;                 ///< a folder of another program's images (ExternalImages)
    std::filesystem::path against;                ///< another of the same views, by the same engine; "": none
    std::string scene;                            ///< in place of the names of the views; "": these are found by them
    std::filesystem::path capture, reference;     ///< in place of a scene; "": none
    unsigned samples = 256;                       ///< of the references, per pixel
    double margin = PrimaryComparisons().margin;  ///< of equivalence
    RunSettings run;                              ///< its folder gets the study and the page
};

/// A view's images in a folder of an engine's frames, by what the names say: SCENE.CAMERA.WIDTHxHEIGHT/fFRAME.s0.exr.
struct FramesOfView {
    std::filesystem::path folder = {};
    ViewName name = {};
    int width = 0, height = 0;
    std::set<unsigned> frames = {};  ///< not empty
};

/// Sorted by name and size. `scene`: the name of the one that was asked for; "": those of the search path. Fails with
/// Error as view_name().
std::vector<FramesOfView> views_of_frames(const std::filesystem::path& folder, const std::string& scene,
                                          const std::vector<std::filesystem::path>& search_path);

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
