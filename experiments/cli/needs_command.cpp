// ssrlab needs: what a scene holds, the work that can be skipped for it, and what that saves.
#include "core/files.h"
#include "core/gpu/device.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/results/files/csv.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/config/shots/scene_warnings.h"
#include "experiments/study/needs.h"
#include "experiments/study/progress.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>

namespace {

struct NeedsOptions {
    ShotOptions shot;
    unsigned frames = 1;                  ///< of the shot, from shot.frame on
    std::vector<std::string> techniques;  ///< empty: all
    bool is_measured = false;
    unsigned timed_frames = 15;
    std::filesystem::path csv;  ///< "": none
};

Shot shot_of(const NeedsOptions& options, const CommonOptions& common) {
    std::vector<unsigned> frames(options.frames);
    std::iota(frames.begin(), frames.end(), options.shot.frame);
    return load_shot({.scene = options.shot.scene,
                      .choices = {.animation = options.shot.animation},
                      .camera = options.shot.camera,
                      .has_planes_of_scene = options.shot.has_planes_of_scene(),
                      .extent = {options.shot.size[0], options.shot.size[1]},
                      .frames = frames,
                      .direct_lit = true},
                     scene_search_path(common.scene_path));
}

/// One line for each part, with all that skip it.
void print_left_out(const std::vector<LeftOutBy>& all) {
    std::vector<std::string> lines;
    std::map<std::string, std::string> who;
    for (const auto& [name, part] : all) {
        const std::string line = full_name(part) + " (" + part.fact + "): " + part.why +
                                 (part.keeps_bits ? "" : "; the same up to rounding");
        if (!who.contains(line)) lines.push_back(line);
        who[line] += (who[line].empty() ? "" : ", ") + name;
    }
    for (const std::string& line : lines)
        std::printf("  %s\n      by %s\n", shown_text(line).c_str(), shown_text(who[line]).c_str());
    if (lines.empty()) std::printf("  nothing\n");
}

std::string percent(const Estimate& share) {
    char text[64];
    std::snprintf(text, sizeof text, "%5.1f %% [%.1f, %.1f]", 100 * share.value, 100 * share.low, 100 * share.high);
    return text;
}

std::string csv_of(const Shot& shot, const std::vector<MeasuredSaving>& savings) {
    std::string text =
        "shot,technique,point,complete_ms,saved_share,low,high,keeps_bits,repeats_itself,has_same_bits,largest_"
        "difference\n";
    for (const MeasuredSaving& s : savings)
        text += csv_line(shot.name(), s.time.technique, s.time.point, s.time.complete_ms, s.time.share.value,
                         s.time.share.low, s.time.share.high, s.keeps_bits, s.repeats_itself, s.has_same_bits,
                         double(s.largest_difference));
    return text;
}

void print(const std::vector<MeasuredSaving>& savings, const std::vector<SavedTime>& stages) {
    std::printf("\n%-44s %12s  %-22s %s\n", "", "without (ms)", "saved", "images");
    for (const MeasuredSaving& s : savings) {
        char images[64] = "same bits";
        if (!s.repeats_itself) std::snprintf(images, sizeof images, "not compared: no two runs agree");
        if (!s.has_same_bits)
            std::snprintf(images, sizeof images, "%s by %.2g", s.is_as_said() ? "rounded, differ" : "DIFFER",
                          s.largest_difference);
        std::printf("%-44s %12.2f  %-22s %s\n", (s.time.technique + " " + s.time.point).c_str(), s.time.complete_ms,
                    percent(s.time.share).c_str(), images);
    }
    std::printf("\nLargest saving of each stage by any preset:\n");
    for (const SavedTime& stage : stages) std::printf("%-44s %9.2f ms\n", stage.stage.c_str(), stage.milliseconds);
}

}  // namespace

static int needs_command(const NeedsOptions& options, const CommonOptions& common) {
    const Shot shot = shot_of(options, common);
    const std::vector<PointConfig> points = all_points(options.techniques);
    std::printf("%s, camera %s\n\n", shown_text(shot.scene.name).c_str(), shown_text(shot.camera.name).c_str());
    for (const SceneFact& fact : list_facts(shot.scene, shot.facts))
        std::printf("  %-22s %-10s %s\n", fact.name.c_str(), fact.value.c_str(), fact.why.c_str());
    std::printf("\nSkipped, as it cannot change a pixel here:\n");
    print_left_out(left_out_of(shot, points));
    for (const std::string& warning : warning_sentences(shot.scene))
        std::printf("warning: %s\n", shown_text(warning).c_str());
    if (!options.is_measured) return 0;

    Device device(common.device);
    Progress progress(1.0);
    const MeasuredSavings savings = measure_savings(device, shot, points, options.timed_frames,
                                                    [&](double share) { progress.update(share, "timing"); });
    print(savings.of, savings.stages);
    if (savings.load.disturbed > 0)
        std::printf("\nwarning: other programs disturbed %u of %u timed frames; run it again on an idle machine\n",
                    savings.load.disturbed, options.timed_frames);
    if (!options.csv.empty()) write_text(options.csv, csv_of(shot, savings.of));
    return std::ranges::all_of(savings.of, &MeasuredSaving::is_as_said) ? 0 : 1;
}

void add_needs(Commands& line) {
    NeedsOptions& needs = line.keep<NeedsOptions>();
    CLI::App& command = line.add("needs",
                                 "List what a scene contains, and which work the rasteriser, the path tracer and the "
                                 "techniques leave out because of that",
                                 "ssrlab needs fence");
    add_shot(command, needs.shot);
    option(command, "--frames N", needs.frames, "Number of frames of the shot; default: 1, so that nothing moves")
        ->check(CLI::Range(1, 10000));
    option(command, "--techniques NAME", needs.techniques,
           "Techniques, folders of techniques, or single presets as NAME:PRESET; default: all presets of all "
           "techniques, and all tracers")
        ->delimiter(',');
    command.add_flag("--measure", needs.is_measured,
                     "Render with and without the work that is left out. Print the time saved and whether the images "
                     "are the same (exit code 1 if not)");
    option(command, "--timed-frames N", needs.timed_frames, "Measured frames of each point; default: 15")
        ->check(CLI::Range(1, 10000));
    option(command, "--csv FILE.csv", needs.csv, "Also write the measurements");
    add_device(command, line.common), add_scene_path(command, line.common);
    add_reading(command);
    command.callback([&] { line.status = needs_command(needs, line.common); });
}
