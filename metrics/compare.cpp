#include "metrics/compare.h"

#include "core/digits.h"
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/list_text.h"
#include "core/number_text.h"
#include "core/png.h"
#include "core/reading_limits.h"
#include "core/shown_text.h"
#include "metrics/color_map.h"
#include "metrics/compare_video.h"
#include "metrics/compared_files.h"
#include "metrics/cvvdp_metric.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace {

/// What each comparison should show; SSIM and HDR-FLIP only where the image allows them.
std::vector<std::string> default_metrics(glm::uvec2 extent, bool has_flip_exposures) {
    std::vector<std::string> names = {"mse",   "relmse", "relmse_trimmed", "outliers", "mae",
                                      "smape", "bias",   "energy_ratio",   "psnr"};
    if (std::min(extent.x, extent.y) >= 11) names.push_back("ssim");
    names.push_back("flip");
    if (has_flip_exposures) names.push_back("hdr_flip");
    return names;
}

bool is_asked_for(const CompareOptions& options, const std::string& metric) {
    return std::ranges::find(options.metrics, metric) != options.metrics.end();
}

void choose_flip_exposures(Comparison& comparison, const ComparedImage& reference) {
    CompareOptions& options = comparison.options;
    if (options.settings.flip_exposures) return;
    const bool is_needed = is_asked_for(options, "hdr_flip");
    const bool is_default = options.metrics.empty() && reference.is_radiance;
    if (!is_needed && !is_default) return;
    try {
        options.settings.flip_exposures = flip_exposure_range(reference.linear, options.settings.hdr_flip_tone_map);
    } catch (const Error& error) {
        if (is_needed) throw;
        comparison.warnings.push_back(std::string("hdr_flip is left out: ") + error.what());
    }
}

void write_map(const CompareOptions& options, const std::vector<CompareResult>& results) {
    if (lower_case_extension(options.map) == ".png") {
        if (results.size() != 1)
            fail("cannot draw the maps of ", results.size(), " metrics into ", options.map.string(),
                 ": name one with --metric, or write .exr");
        const bool is_signed = results[0].metric->better == Better::near_zero;
        write_png(options.map, is_signed ? false_color_signed(results[0].map, options.map_max)
                                         : false_color(results[0].map, options.map_max));
        return;
    }
    LayeredImage image;
    for (const CompareResult& result : results) {
        HostImage map(result.map.extent, 1);
        std::ranges::transform(result.map.values, map.values.begin(), [](double v) { return float(v); });
        image.layers.push_back(
            {.name = results.size() == 1 ? "" : result.metric->name, .channel_names = "Y", .image = map});
        image.attributes["ssrlab." + result.metric->name] = result.metric->formula;
    }
    write_exr(options.map, image);
}

nlohmann::json number(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(shortest_digits(value));  // JSON knows no inf
}

nlohmann::json to_json(const PixelCounts& counts) {
    return {{"nan", counts.nan}, {"infinite", counts.infinite}, {"negative", counts.negative}};
}

bool needs_display(const CompareOptions& options) {
    return std::ranges::any_of(options.metrics,
                               [](const std::string& name) { return metric_named(name).is_of_display; });
}

void check_visibility_options(const CompareOptions& options) {
    if (!options.display.empty()) display_named(options.display);
    if (!needs_display(options) && (!options.display.empty() || options.nits_per_unit))
        fail(
            "a display and nits per unit are for metrics of displayed light; add --metric cvvdp_0_5_6, psnr_pu21 or "
            "ssim_pu21, or leave them out");
    if (options.video && options.metrics != std::vector<std::string>{"cvvdp_0_5_6"})
        fail("videos are compared by cvvdp_0_5_6 alone: give --metric cvvdp_0_5_6 and no other metric");
}

void check(const CompareOptions& options) {
    for (const std::string& name : options.metrics) metric_named(name);
    check_visibility_options(options);
    if (!options.map.empty() && lower_case_extension(options.map) != ".exr" &&
        lower_case_extension(options.map) != ".png")
        fail("cannot write the error map ", options.map.string(), ": its name must end in .exr or .png");
    if (!(options.map_max > 0)) fail("the scale of the error map is ", options.map_max, ", but must be above 0");
}

Comparison compare_images(const CompareOptions& options) {
    Comparison comparison{.options = options};
    ComparedImage reference = read_compared_image(options.reference, options, comparison.warnings);
    constexpr double bytes_per_pixel = 300;  // of both images and all maps, as measured with the default metrics
    MemoryShare memory;
    memory.add(double(reference.linear.pixel_count()) * bytes_per_pixel,
               options.reference.string() + ": the comparison of its " +
                   std::to_string(reference.linear.pixel_count()) + " pixels");
    ComparedImage test = read_compared_image(options.test, options, comparison.warnings);
    if (reference.linear.extent != test.linear.extent)
        fail(options.reference.string(), " has ", reference.linear.extent.x, "x", reference.linear.extent.y,
             " pixels, but ", options.test.string(), " has ", test.linear.extent.x, "x", test.linear.extent.y,
             ": both must be of one size");
    for (ComparedImage* source : {&reference, &test})  // of which the memory is set aside
        if (source->is_radiance)
            source->codes = display_codes(source->linear, options.settings.exposure_ev, options.settings.tone_map);
    comparison.extent = reference.linear.extent;
    comparison.reference_counts = count_bad_pixels(reference.linear);
    comparison.test_counts = count_bad_pixels(test.linear);
    report_bad_pixels(comparison);

    choose_flip_exposures(comparison, reference);
    CompareOptions& used = comparison.options;
    if (needs_display(used)) {
        comparison.is_radiance = reference.is_radiance;
        choose_display(used, reference.is_radiance);
        warn_of_clipped(count_clipped(reference.linear, used.settings), used.reference, used.settings,
                        comparison.warnings);
        warn_of_clipped(count_clipped(test.linear, used.settings), used.test, used.settings, comparison.warnings);
    }
    if (used.metrics.empty())
        used.metrics = default_metrics(comparison.extent, used.settings.flip_exposures.has_value());
    const ImagePair pair = image_pair(reference.linear, test.linear, reference.codes, test.codes, used.settings);
    comparison.pixels = pair.finite.count();
    if (comparison.pixels == 0)
        fail(options.reference.string(), " and ", options.test.string(), " have no pixel that is finite in both");

    for (const std::string& name : used.metrics) {
        const Metric& metric = metric_named(name);
        std::vector<Plane> layers = metric.layers(pair);
        const double value = metric.pool(layers, pair.finite);
        comparison.results.push_back({&metric, value, std::move(layers.front())});
    }
    return comparison;
}

/// What a JOD of this comparison depends on; PU21 codes depend on the light alone.
nlohmann::json viewing_json(const Comparison& comparison) {
    const CompareOptions& options = comparison.options;
    const Viewing viewing = exposed_viewing(options.settings);
    nlohmann::json json = {{"display", viewing.display.name}};
    if (viewing.display.transfer == Transfer::linear) json["nits_per_unit"] = viewing.nits_per_unit;
    if (!is_asked_for(options, "cvvdp_0_5_6")) return json;
    json["pixels_per_degree"] = viewing.display.pixels_per_degree;
    json["version"] = cvvdp_0_5_6_calibration().version;
    if (!options.video) return json;
    json["frames_per_second"] = options.video->frames_per_second;
    json["padding"] = name_of(options.video->padding);
    json["frames"] = comparison.frames;
    json["pooled_frames"] = comparison.pooled_frames;
    return json;
}

std::string viewing_text(const Comparison& comparison, const Metric& metric) {
    const CompareOptions& options = comparison.options;
    const Viewing viewing = exposed_viewing(options.settings);
    std::string text = viewing.display.name;
    if (viewing.display.transfer == Transfer::linear)
        text += ", " + number_text(viewing.nits_per_unit, 6) + " nits per unit";
    else if (comparison.is_radiance)
        text += ", exposure " + number_text(options.settings.exposure_ev) + " EV, tone map " +
                name_of(options.settings.tone_map);
    if (metric.name != "cvvdp_0_5_6") return text;
    text += ", " + number_text(viewing.display.pixels_per_degree, 6) + " pixels per degree";
    if (options.video)
        text += ", " + number_text(options.video->frames_per_second, 6) + " frames per second, padding " +
                name_of(options.video->padding) + ", " + counted(comparison.pooled_frames, "frame") + " pooled";
    return text + ", version " + cvvdp_0_5_6_calibration().version;
}

}  // namespace

Comparison compare(const CompareOptions& options) {
    check(options);
    Comparison comparison = options.video ? compare_videos(options) : compare_images(options);
    if (!options.map.empty()) write_map(comparison.options, comparison.results);
    return comparison;
}

void print(const Comparison& comparison, std::ostream& out, std::ostream& warnings) {
    for (const std::string& warning : comparison.warnings) warnings << "warning: " << shown_text(warning) << '\n';
    for (const CompareResult& result : comparison.results)
        out << result.metric->name << ' ' << shortest_digits(result.value)
            << (result.metric->is_of_display ? " (" + viewing_text(comparison, *result.metric) + ")\n" : "\n");
}

nlohmann::json to_json(const Comparison& comparison) {
    const CompareOptions& options = comparison.options;
    nlohmann::json settings = {{"exposure_ev", options.settings.exposure_ev},
                               {"tone_map", name_of(options.settings.tone_map)},
                               {"pixels_per_degree", options.settings.pixels_per_degree}};
    if (const auto& exposures = options.settings.flip_exposures) {
        settings["flip_exposures"] = {exposures->start, exposures->stop, exposures->count};
        settings["hdr_flip_tone_map"] = name_of(options.settings.hdr_flip_tone_map);
    }
    if (needs_display(options)) settings["viewing"] = viewing_json(comparison);
    nlohmann::json results = nlohmann::json::array();
    for (const CompareResult& r : comparison.results)
        results.push_back({{"metric", r.metric->name},
                           {"formula", r.metric->formula},
                           {"unit", r.metric->unit},
                           {"value", number(r.value)}});
    return {{"reference", options.reference.string()},
            {"test", options.test.string()},
            {"layer", options.layer},
            {"width", comparison.extent.x},
            {"height", comparison.extent.y},
            {"pixels", comparison.pixels},
            {"reference_bad_pixels", to_json(comparison.reference_counts)},
            {"test_bad_pixels", to_json(comparison.test_counts)},
            {"settings", settings},
            {"warnings", comparison.warnings},
            {"metrics", results}};
}
