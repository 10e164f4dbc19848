// ssrlab compare: two images.
#include "experiments/cli/commands.h"
#include "metrics/compare.h"
#include "metrics/tone_map.h"

#include <iostream>

namespace {

struct CompareCommandOptions {
    std::filesystem::path reference, test, map;
    std::string layer;
    std::vector<std::string> metrics;
    bool as_json = false, fail_on_non_finite = false;
    float exposure_ev = 0.0f, map_max = 1.0f;
    std::string tone_map = "none";
};

}  // namespace

static void compare_images_command(const CompareCommandOptions& options) {
    const Comparison result =
        compare({.reference = options.reference,
                 .test = options.test,
                 .layer = options.layer,
                 .metrics = options.metrics,
                 .map = options.map,
                 .map_max = options.map_max,
                 .settings = {.exposure_ev = options.exposure_ev, .tone_map = tone_map_named(options.tone_map)},
                 .fail_on_non_finite = options.fail_on_non_finite});
    if (options.as_json)
        std::cout << to_json(result).dump(2, ' ', /*ensure_ascii=*/true) << '\n';
    else
        print(result, std::cout, std::cerr);
}

void add_compare(Commands& line) {
    CompareCommandOptions& compare = line.keep<CompareCommandOptions>();
    CLI::App& command =
        line.add("compare", "Compare two images (OpenEXR, Radiance or PNG) and print one number per line");
    option(command, "reference REFERENCE", compare.reference,
           "Image that is right: .exr or .hdr (linear radiance), or .png (sRGB)")
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
        ->check(CLI::IsMember(tone_map_names))
        ->capture_default_str();
    command.add_flag("--fail-on-non-finite", compare.fail_on_non_finite,
                     "Exit with code 2 if a pixel is NaN or infinite. By default, such pixels are left out and counted "
                     "in a warning");
    command.add_flag("--json", compare.as_json, "Print one JSON object");
    add_reading(command);
    command.callback([&] { compare_images_command(compare); });
}
