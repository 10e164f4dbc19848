#pragma once
#include "experiments/results/verdicts/verdict_text.h"
#include "experiments/study/run.h"
#include "experiments/study/view_name.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

struct JudgeSettings {
    std::filesystem::path frames;              ///< a folder of another program's images (ExternalImages)
    std::filesystem::path against;             ///< earlier frames of the same views by the same engine; "": none
    std::string scene;                         ///< the scene; "": found by the names of the views
    std::filesystem::path capture, reference;  ///< instead of a scene; "": none
    unsigned samples = 256;                    ///< samples per pixel of the references
    JudgeLimits limits;                        ///< between better, equivalent and worse
    RunSettings run;                           ///< `run.out` gets the study, verdict.json and the page
};

/// A view's images in a folder of an engine's frames, from their names: SCENE.CAMERA.WIDTHxHEIGHT/fFRAME.s0.exr.
struct FramesOfView {
    std::filesystem::path folder = {};
    ViewName name = {};
    int width = 0, height = 0;
    std::set<unsigned> frames = {};  ///< not empty
};

/// All views in a folder, sorted by name and size. `scene`: the scene that was asked for; "": looked up in the search
/// path. Fails with Error as view_name().
std::vector<FramesOfView> views_of_frames(const std::filesystem::path& folder, const std::string& scene,
                                          const std::vector<std::filesystem::path>& search_path);

/// The result for a view without earlier frames to compare with.
struct ViewError {
    std::string shot;
    std::optional<double> error, low, high;  ///< the primary error (PrimaryComparisons), 95 % interval
    std::optional<double> ratio_to_none;     ///< error / error without reflections
};

struct JudgedFrames {
    std::vector<ViewError> errors;
    std::optional<Judgement> against;  ///< set if there are frames to compare with
    VerdictText text;                  ///< what terminal and page say
};

/// Measures a renderer's frames in all views of their folder, by a study in settings.run.out whose report has masks,
/// maps and numbers. The verdict is of the error, and of flicker, ghosts and visibility where a view has several
/// frames.
/// verdict.json holds it, and the page begins with it. Fails with Error if a view cannot be found or compared.
JudgedFrames judge_frames(const JudgeSettings& settings);
