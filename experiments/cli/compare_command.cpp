// ssrlab compare: two images, or two videos of numbered frames.
#include "core/error.h"
#include "core/list_text.h"
#include "core/numbered_files.h"
#include "experiments/cli/commands.h"
#include "metrics/compare.h"
#include "metrics/cvvdp/temporal_filters.h"
#include "metrics/tone_map.h"

#include <iostream>

namespace {

constexpr const char* default_padding = "replicate";  // of the authors' program as a library

struct CompareCommandOptions {
    std::filesystem::path reference, test, map;
    std::string layer;
    std::vector<std::string> metrics;
    bool as_json = false, fail_on_non_finite = false;
    float exposure_ev = 0.0f, map_max = 1.0f;
    std::string tone_map = "none", display;
    std::optional<double> nits_per_unit, frames_per_second;
    std::optional<std::string> padding;
};

/// Nothing for two stills. Patterns of numbered frames need a frame rate.
std::optional<VideoOptions> video_of(const CompareCommandOptions& options) {
    const bool is_video = is_numbered_pattern(options.reference);
    if (is_video != is_numbered_pattern(options.test))
        fail(options.reference.string(), " and ", options.test.string(),
             ": one is a pattern of numbered frames and the other is a file; give two of one kind");
    if (!is_video && (options.frames_per_second || options.padding))
        fail(
            "--fps and --padding are for videos: give both as patterns, for example frame_####.exr, or leave them "
            "out");
    if (!is_video) return std::nullopt;
    if (!options.frames_per_second) fail("a video needs its frame rate: give --fps, for example --fps 30");
    return VideoOptions{.frames_per_second = *options.frames_per_second,
                        .padding = temporal_padding_named(options.padding.value_or(default_padding))};
}

}  // namespace

static void compare_images_command(const CompareCommandOptions& options) {
    // Not among the initialisers: where one of them throws, GCC 12 destroys earlier ones twice.
    const std::optional<VideoOptions> video = video_of(options);
    const Comparison result =
        compare({.reference = options.reference,
                 .test = options.test,
                 .layer = options.layer,
                 .metrics = options.metrics,
                 .map = options.map,
                 .map_max = options.map_max,
                 .settings = {.exposure_ev = options.exposure_ev, .tone_map = tone_map_named(options.tone_map)},
                 .display = options.display,
                 .nits_per_unit = options.nits_per_unit,
                 .video = video,
                 .fail_on_non_finite = options.fail_on_non_finite});
    if (options.as_json)
        std::cout << to_json(result).dump(2, ' ', /*ensure_ascii=*/true) << '\n';
    else
        print(result, std::cout, std::cerr);
}

void add_compare(Commands& line) {
    CompareCommandOptions& compare = line.keep<CompareCommandOptions>();
    CLI::App& command =
        line.add("compare", "Compare two images or videos (OpenEXR, Radiance or PNG) and print one number per line",
                 "ssrlab compare reference.exr test.exr");
    option(
        command, "reference REFERENCE", compare.reference,
        "Image that is right: .exr or .hdr (linear radiance), or .png (sRGB); or the numbered frames of a video, for "
        "example frame_####.exr")
        ->required();
    option(command, "test TEST", compare.test, "Image that is judged, of the same size and kind")->required();
    option(command, "--metric NAME", compare.metrics,
           "Metric (see: ssrlab list metrics); may be repeated. Default: mse, relmse, relmse_trimmed, outliers, mae, "
           "smape, bias, energy_ratio, psnr and flip; also ssim if the image is large enough, and hdr_flip for an EXR "
           "reference");
    option(command, "--layer NAME", compare.layer,
           "Layer, part, view or channel of an EXR file that has several, for example specular. Default: the one "
           "without a name, else image, else the only one with R, G and B");
    option(command, "--map FILE", compare.map,
           "Write the error map as .exr (a layer for each metric) or .png (one metric in false colour)");
    option(command, "--map-max", compare.map_max, "Error that has the brightest colour in a .png map")
        ->check(positive())
        ->capture_default_str();
    option(command, "--exposure EV", compare.exposure_ev, "Exposure of display metrics: radiance is multiplied by 2^EV")
        ->check(real_in(-100, 100, "a number from -100 to 100"))
        ->capture_default_str();
    option(command, "--tone-map", compare.tone_map,
           "Tone map that is applied before display metrics (psnr, ssim, flip)")
        ->check(name_among(tone_map_names))
        ->capture_default_str();
    option(command, "--display NAME", compare.display,
           "Display that shows the images to cvvdp_0_5_6, psnr_pu21 and ssim_pu21: " +
               joined(names_of(displays(), &Display::name)) +
               ". Default: standard_hdr_linear for radiance, standard_4k for .png")
        ->check(name_among(names_of(displays(), &Display::name)));
    option(command, "--nits-per-unit N", compare.nits_per_unit,
           "Light of radiance 1 on a linear display (cd/m2). Default: 203, the white of ITU-R BT.2408")
        ->check(positive());
    option(command, "--fps N", compare.frames_per_second,
           "Frames per second of a video, from 1 to 240. Videos have no default")
        ->check(real_in(least_frame_rate, greatest_frame_rate, "a number from 1 to 240"));
    option(
        command, "--padding NAME", compare.padding,
        "What cvvdp_0_5_6 sees before a video's first frame: replicate (that frame), symmetric (the video backwards) "
        "or warm_up (nothing: only frames with a full window of a quarter of a second are scored). Default: "
        "replicate")
        ->check(name_among(temporal_padding_names));
    command.add_flag("--fail-on-non-finite", compare.fail_on_non_finite,
                     "Exit with code 2 if a pixel is NaN or infinite. By default, such pixels are left out and counted "
                     "in a warning");
    command.add_flag("--json", compare.as_json, "Print one JSON object");
    add_reading(command);
    command.callback([&] { compare_images_command(compare); });
}
