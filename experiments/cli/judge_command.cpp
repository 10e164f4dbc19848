// ssrlab judge: how far a renderer's frames are from the truth, and whether they err more than those before.
#include "core/cache_folder.h"
#include "core/error.h"
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
    JudgeLimits limits;
    bool fails_if_worse = false;
};

constexpr double most_tolerance = 1000;  // a larger one would pass everything

void say(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) std::printf("%s\n", shown_text(line).c_str());
}

}  // namespace

static int judge_command(const JudgeOptions& options, const CommonOptions& common) {
    if (!options.capture.empty() && options.reference.empty())
        fail("--capture needs --reference, what `ssrlab reference` wrote of the captured frame");
    if (options.limits.worse_by > 1 && options.against.empty())
        fail("--worse-by needs --against, a folder of frames that these may exceed by so much");
    if (options.fails_if_worse && options.against.empty())
        fail("--fail-if-worse needs --against, a folder of frames to be no worse than");
    const JudgedFrames judged =
        judge_frames({.frames = options.frames,
                      .against = options.against,
                      .scene = options.scene,
                      .capture = options.capture,
                      .reference = options.reference,
                      .samples = options.samples,
                      .limits = options.limits,
                      .run = {.out = options.out,
                              .device = common.device,
                              .cache = common.cache.empty() ? default_cache_folder() : common.cache,
                              .search_path = scene_search_path(common.scene_path),
                              .write_report = write_page}});
    std::printf("\n");
    if (!judged.against) {
        say(judged.text.numbers);
        return 0;
    }
    say(judged.text.numbers), say(judged.text.rules), say({judged.text.headline});
    return options.fails_if_worse && judged.against->verdict == judgement::worse ? 1 : 0;
}

void add_judge(Commands& line) {
    JudgeOptions& judge = line.keep<JudgeOptions>();
    CLI::App& command = line.add(
        "judge",
        "Judge frames of another renderer by the truth, and compare them with earlier frames of that renderer. The "
        "verdict is better, worse, equivalent, undecided or identical. It is of the error, and of sequences also of "
        "flicker, ghosts and visibility. At most 1 % of runs without a change are called worse or better",
        "ssrlab judge my_frames");
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
    add_margin(command, judge.limits.margin, "0.05");
    option(
        command, "--worse-by R", judge.limits.worse_by,
        "Tolerance: frames are worse only if their error or flicker is certainly more than R times that of the earlier "
        "frames, for example 1.05. A change that is certainly less is \"equivalent\". With 1, any certain increase is "
        "worse; default: 1")
        ->check(real_in(1, most_tolerance, "a ratio of errors from 1 to 1000, for example 1.05"));
    add_scene_path(command, line.common), add_device(command, line.common), add_cache(command, line.common);
    add_reading(command);
    command.callback([&] { line.status = judge_command(judge, line.common); });
}
