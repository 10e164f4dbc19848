// The commands that need no Vulkan device: reference, compare.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/files.h"
#include "core/gbuffer/scene_facts.h"
#include "core/number_text.h"
#include "core/png.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/study/config/shots/scene_warnings.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/progress.h"
#include "groundtruth/paths/path_tracer.h"
#include "groundtruth/reference/reference_audit.h"
#include "groundtruth/reference/reference_cache.h"
#include "groundtruth/reference/reference_error.h"
#include "groundtruth/reference/reference_file.h"
#include "groundtruth/reference/truth_ladder.h"

#include <cmath>
#include <cstdio>
#include <iostream>

namespace {

struct ReferenceCommandOptions {
    ShotOptions shot;
    ReferenceSettings settings;
    std::filesystem::path out;
};

Shot load_single_shot(const ShotOptions& options, const CommonOptions& common) {
    const ShotConfig config{.scene = options.scene,
                            .choices = {.animation = options.animation},
                            .camera = options.camera,
                            .has_planes_of_scene = options.has_planes_of_scene(),
                            .extent = {options.size[0], options.size[1]},
                            .frames = {options.frame}};
    return load_shot(config, scene_search_path(common.scene_path));
}

/// "76900 rays", "4.61 million rays", "1.2 billion rays".
std::string rays_text(double rays) {
    if (rays < 1e6) return fixed_text(rays) + " rays";
    return rays < 1e9 ? number_text(rays * 1e-6, 3) + " million rays" : number_text(rays * 1e-9, 3) + " billion rays";
}

/// Root of a noise-free mean square with its interval, in percent of `unit`.
std::string rms_percent(const LadderDifference& difference, double unit) {
    const auto root = [&](double square) { return 100 * std::sqrt(std::max(square, 0.0)) / unit; };
    const std::string value = fixed_text(root(difference.square), 2);
    return std::string(value.size() < 6 ? 6 - value.size() : 0, ' ') + value + " [" +
           fixed_text(root(difference.square - 1.96 * difference.square_error), 2) + ", " +
           fixed_text(root(difference.square + 1.96 * difference.square_error), 2) + "]";
}

void print_ladder(const LadderSummary& ladder) {
    if (ladder.mean_specular <= 0) {
        std::printf("truth ladder: nothing reflects\n");
        return;
    }
    std::printf(
        "truth ladder, in %% of the mean specular light %.4g of %zu reflecting pixels; the image shows %.1f %% of what "
        "they reflect\n",
        ladder.mean_specular, ladder.pixels, 100 * ladder.on_screen_share);
    std::printf("  %-16s %-31s %16s  %-22s  %s\n", "rung", "approximation", "mean change", "RMS of the step [95 %]",
                "RMS from the truth [95 %]");
    for (const LadderRung& rung : ladder.rungs) {
        char mean[32];
        std::snprintf(mean, sizeof mean, "%+.2f +- %.2f", 100 * rung.step.mean / ladder.mean_specular,
                      196 * rung.step.mean_error / ladder.mean_specular);
        std::printf("  %-16s %-31s %16s  %-22s  %s\n", rung.name.c_str(), rung.costs.c_str(), mean,
                    rms_percent(rung.step, ladder.mean_specular).c_str(),
                    rms_percent(rung.from_truth, ladder.mean_specular).c_str());
    }
}

}  // namespace

static void reference_command(const ReferenceCommandOptions& options, const CommonOptions& common) {
    if (lower_case_extension(options.out) == ".png")
        fail("--out ", options.out,
             ": a reference is an EXR file; name FILE.exr, and a PNG of the image is written beside it");
    const Shot shot = load_single_shot(options.shot, common);
    for (const std::string& warning : warning_sentences(shot.scene))
        std::fprintf(stderr, "warning: %s\n", shown_text(warning).c_str());
    const ShotFrame frame = shot_frame(shot, options.shot.frame);

    Progress progress(1.0);
    ReferenceRun run;
    run.progress = [&](double fraction, double rays_per_second, double) {
        progress.update(fraction, ray_rate_text(rays_per_second));
    };
    run.notice = [&](const std::string& text) { progress.say("note: " + text); };
    Reference reference = cached_reference(shot.scene, frame.scene, frame.camera, shot.config.extent, options.settings,
                                           common.cache.empty() ? default_cache_folder() : common.cache, run);
    const std::filesystem::path out =
        options.out.empty() ? std::filesystem::path(shot.scene.name + "_reference.exr") : options.out;
    const ErrorSummary error = relative_error_summary(reference, reference.specular);
    write_reference(out, reference, options.settings);
    std::filesystem::path picture = out;
    picture.replace_extension(".png");
    write_png(picture, channels_of(reference.image.mean, 0, 3), shot.camera.exposure_ev);

    progress.say(out.string() + (reference.from_cache ? " (from the cache)" : ""));
    progress.say(picture.string());
    std::printf("passes %s samples per pixel, %s, %s\n", reference.passes.c_str(),
                format_duration(reference.seconds).c_str(), rays_text(double(reference.rays)).c_str());
    std::printf(
        "relative standard error of the specular light at a pixel: median %.2f %%, 95 %% of pixels below %.2f %%\n",
        100 * error.median, 100 * error.p95);
    if (options.settings.target_relative_error > 0)
        std::printf("%.1f %% of the pixels reached the target\n", 100 * reference.reached_share);
    if (options.settings.ladder) print_ladder(summarize_ladder(reference));
    for (const std::string& warning : audit_reference(reference).warnings)
        std::printf("warning: %s\n", shown_text(warning).c_str());
    if (reference.non_finite_samples)
        std::printf("warning: %llu samples were not finite and count as zero\n",
                    (unsigned long long)reference.non_finite_samples);
}

void add_reference(Commands& line) {
    ReferenceCommandOptions& reference = line.keep<ReferenceCommandOptions>();
    CLI::App& command = line.add("reference", "Path-trace a scene; a stopped render continues",
                                 "ssrlab reference fence --samples 1024");
    add_shot(command, reference.shot);
    option(command, "--samples", reference.settings.max_samples,
           "Largest number of samples per pixel, rounded up to 16 x 2^k; default: " +
               std::to_string(ReferenceSettings::default_samples) + ", or no limit with --seconds or --target")
        ->check(CLI::Range(16, 1 << 24));
    option(command, "--adaptive-share", reference.settings.adaptive_share,
           "Further directions of each sample, on average over the image, for the pixels whose noise decides the "
           "interval of mse, for example 0.25; not with --target")
        ->check(real_in(0, ReferenceSettings::most_adaptive_share, "a number from 0 to 8"));
    command
        .add_flag("--adaptive-image", reference.settings.adaptive_image,
                  "The share is for the noise of the image relative to its brightness, in place of that of mse")
        ->needs("--adaptive-share");
    option(command, "--lit-samples", reference.settings.lit_samples,
           "Largest number of these samples that also trace diffuse light. The others trace specular light only. "
           "Default: all")
        ->check(CLI::Range(16, 1 << 24));
    option(command, "--guide-samples", reference.settings.guide_samples,
           "Samples per pixel of the guide image, which weighs relative errors and steers Russian roulette")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    option(command, "--seconds", reference.settings.max_seconds,
           "Time limit in seconds, not counting the samples of the guide; default: no limit")
        ->check(positive());
    option(command, "--target", reference.settings.target_relative_error,
           "Relative standard error of the specular light at a pixel at which the render stops, for example 0.03")
        ->check(real_in(1e-4, 1, "a number from 0.0001 to 1"));
    command.get_option("--adaptive-share")->excludes(command.get_option("--target"));
    option(command, "--max-depth", reference.settings.max_depth,
           "Largest number of reflections of a path; the camera ray does not count")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    option(command, "--seed", reference.settings.seed, "Seed of the path tracer")->capture_default_str();
    command.add_flag("--ladder", reference.settings.ladder,
                     "Also render the truth ladder: the errors that remain if the BRDF is factored, if only one view "
                     "and one bounce are known, and if only the screen is known. Needs about twice the rays");
    option(command, "--out FILE.exr", reference.out,
           "Output file, with a PNG of the image beside it; default: <scene>_reference.exr");
    add_scene_path(command, line.common), add_cache(command, line.common);
    add_reading(command);
    command.callback([&] { reference_command(reference, line.common); });
}
