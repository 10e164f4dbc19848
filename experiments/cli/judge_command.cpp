// ssrlab judge: how far a renderer's frames are from the truth, and whether they err more than those before.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/number_text.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/bridges/judge.h"
#include "experiments/cli/commands.h"
#include "experiments/report/report.h"

#include <cstdio>

namespace {

struct JudgeOptions {
    std::filesystem::path frames, against, capture, reference, out = "results/judge";  ///< "": none
    std::string scene;                                                                 ///< "": by the views' names
    unsigned samples = 256;
    double margin = 0;  ///< 0: PrimaryComparisons'
    bool fails_if_worse = false;
};

std::string error_text(const ViewError& view) {
    if (!view.error) return "no error: nothing reflects in this view";
    std::string text = "mse " + number_text(*view.error);
    if (view.low && view.high) text += " [" + number_text(*view.low) + ", " + number_text(*view.high) + "]";
    if (view.ratio_to_none) text += ", " + number_text(*view.ratio_to_none, 3) + " times that of no reflections";
    return text;
}

void print(const JudgedView& view, const std::string& before) {
    std::printf(
        "%s: mse %.4g [%.4g, %.4g] times that of %s: %s (p %.2g; %.3g times it would be seen in 95 %% of runs)\n",
        shown_text(view.shot).c_str(), view.ratio, view.low, view.high, before.c_str(), view.verdict.c_str(),
        view.p_holm, view.detectable);
}

}  // namespace

static int judge_command(const JudgeOptions& options, const CommonOptions& common) {
    if (!options.capture.empty() && options.reference.empty())
        fail("--capture needs --reference, what `ssrlab reference` wrote of the captured frame");
    if (options.fails_if_worse && options.against.empty())
        fail("--fail-if-worse needs --against, a folder of frames to be no worse than");
    const JudgedFrames judged =
        judge_frames({.frames = options.frames,
                      .against = options.against,
                      .scene = options.scene,
                      .capture = options.capture,
                      .reference = options.reference,
                      .samples = options.samples,
                      .margin = options.margin > 0 ? options.margin : PrimaryComparisons().margin,
                      .run = {.out = options.out,
                              .device = common.device,
                              .cache = common.cache.empty() ? default_cache_folder() : common.cache,
                              .search_path = scene_search_path(common.scene_path),
                              .write_report = write_page}});
    std::printf("\n");
    for (const ViewError& view : judged.errors)
        std::printf("%s: %s\n", shown_text(view.shot).c_str(), error_text(view).c_str());
    if (!judged.against) return 0;
    const std::string before = shown_text(options.against.string());
    for (const JudgedView& view : judged.against->views) print(view, before);
    std::printf("%s against %s\n", judged.against->verdict.c_str(), before.c_str());
    return options.fails_if_worse && judged.against->verdict == judgement::worse ? 1 : 0;
}

void add_judge(Commands& line) {
    JudgeOptions& judge = line.keep<JudgeOptions>();
    CLI::App& command = line.add(
        "judge",
        "Judge frames of another renderer by the truth, and compare them with earlier frames of that renderer. The "
        "verdict is better, worse, equivalent, undecided or identical (at most 1 % false alarms)");
    option(command, "frames FRAMES", judge.frames,
           "Folder with external.json and SCENE.CAMERA.WIDTHxHEIGHT/fFRAME.sSEED.exr, as `experiments/docs/judge.md` "
           "describes")
        ->required();
    option(command, "--scene SCENE", judge.scene,
           "Scene of the views, by name or path; default: found from the names of the views' folders");
    option(command, "--capture DIR", judge.capture, "Captured G-buffer that replaces a scene");
    option(command, "--reference FILE.exr", judge.reference, "Truth of the captured frame; needs --capture");
    option(command, "--against FOLDER", judge.against, "Folder with earlier frames of the same renderer and views");
    command.add_flag("--fail-if-worse", judge.fails_if_worse, "Exit with code 1 if the verdict is \"worse\"");
    option(command, "--samples N", judge.samples, "Samples per pixel of the truth; default: 256")
        ->check(CLI::Range(32, 1 << 20));
    option(command, "--out DIR", judge.out, "Results folder, with a page; default: results/judge");
    add_margin(command, judge.margin, "0.05");
    add_scene_path(command, line.common), add_device(command, line.common), add_cache(command, line.common);
    add_reading(command);
    command.callback([&] { line.status = judge_command(judge, line.common); });
}
