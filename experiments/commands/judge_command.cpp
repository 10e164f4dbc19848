// ssrlab judge: how far a renderer's frames are from the truth, and whether they err more than those before.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/commands/commands.h"
#include "experiments/run/judge.h"

#include <cstdio>

namespace {

std::string error_text(const ViewError& view) {
    char text[160];
    if (!view.error) return "no error: nothing reflects in this view";
    std::snprintf(text, sizeof text, "mse %.4g", *view.error);
    std::string all = text;
    if (view.low && view.high) std::snprintf(text, sizeof text, " [%.4g, %.4g]", *view.low, *view.high), all += text;
    if (view.ratio_to_none)
        std::snprintf(text, sizeof text, ", %.3g times that of no reflections", *view.ratio_to_none), all += text;
    return all;
}

void print(const JudgedView& view, const std::string& before) {
    std::printf(
        "%s: mse %.4g [%.4g, %.4g] times that of %s: %s (p %.2g; %.3g times it would be seen in 95 %% of runs)\n",
        shown_text(view.shot).c_str(), view.ratio, view.low, view.high, before.c_str(), view.verdict.c_str(),
        view.p_holm, view.detectable);
}

}  // namespace

int judge_command(const JudgeOptions& options, const CommonOptions& common) {
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
                              .search_path = scene_search_path(common.scene_path)}});
    std::printf("\n");
    for (const ViewError& view : judged.errors)
        std::printf("%s: %s\n", shown_text(view.shot).c_str(), error_text(view).c_str());
    if (!judged.against) return 0;
    const std::string before = shown_text(options.against.string());
    for (const JudgedView& view : judged.against->views) print(view, before);
    std::printf("%s against %s\n", judged.against->verdict.c_str(), before.c_str());
    return options.fails_if_worse && judged.against->verdict == judgement::worse ? 1 : 0;
}
