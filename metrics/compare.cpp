#include "metrics/compare.h"

#include "core/digits.h"
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/exr/radiance_file.h"
#include "core/files.h"
#include "core/image_format.h"
#include "core/near_miss.h"
#include "core/png.h"
#include "core/reading_limits.h"
#include "core/shown_text.h"
#include "metrics/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

namespace {

struct Source {
    HostImage linear, codes;
    bool is_radiance = true;  ///< else display codes
};

/// linear_from_srgb() of each code. Those of 8 bits, which most are, by a table: the curve takes longer than all else
/// of reading.
HostImage decoded(HostImage codes) {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (size_t code = 0; code < values.size(); ++code) values[code] = linear_from_srgb(float(code) / 255.0f);
        return values;
    }();
    for (float& v : codes.values) {
        const auto code = v >= 0.0f && v <= 1.0f ? size_t(v * 255.0f + 0.5f) : 0;
        v = v == float(code) / 255.0f ? table[code] : linear_from_srgb(v);
    }
    return codes;
}

/// Of radiance, whose codes are not made yet, or of codes, whichever the file's bytes say.
Source read_source(const std::filesystem::path& file, const CompareOptions& options,
                   std::vector<std::string>& warnings) {
    check_regular_file(file);
    const std::vector<uint8_t> bytes = first_bytes(file);
    if (const std::string why = why_unreadable(bytes, file.string(), ImageUse::comparison); !why.empty())
        fail("cannot read ", file.string(), ": it ", why);
    if (image_format(bytes) != ImageFormat::png) return {.linear = read_radiance(file, options.layer, warnings)};
    Source source{.is_radiance = false};
    source.codes = read_png_codes(file, warnings);
    source.linear = decoded(source.codes);
    for (float& v : source.codes.values) v = std::clamp(v, 0.0f, 1.0f);  // as a display shows what it has not
    return source;
}

/// What each comparison should show; SSIM and HDR-FLIP only where the image allows them.
std::vector<std::string> default_metrics(glm::uvec2 extent, bool has_flip_exposures) {
    std::vector<std::string> names = {"mse",   "relmse", "relmse_trimmed", "outliers", "mae",
                                      "smape", "bias",   "energy_ratio",   "psnr"};
    if (std::min(extent.x, extent.y) >= 11) names.push_back("ssim");
    names.push_back("flip");
    if (has_flip_exposures) names.push_back("hdr_flip");
    return names;
}

void choose_flip_exposures(Comparison& comparison, const Source& reference) {
    CompareOptions& options = comparison.options;
    if (options.settings.flip_exposures) return;
    const bool is_asked_for = std::ranges::find(options.metrics, "hdr_flip") != options.metrics.end();
    const bool is_default = options.metrics.empty() && reference.is_radiance;
    if (!is_asked_for && !is_default) return;
    try {
        options.settings.flip_exposures = flip_exposure_range(reference.linear, options.settings.hdr_flip_tone_map);
    } catch (const Error& error) {
        if (is_asked_for) throw;
        comparison.warnings.push_back(std::string("hdr_flip is left out: ") + error.what());
    }
}

void report_bad_pixels(Comparison& comparison) {
    const auto report = [&](const PixelCounts& counts, const std::filesystem::path& file) {
        if (counts.non_finite() + counts.negative == 0) return;
        std::string text = file.string() + ": " + std::to_string(counts.nan) + " pixels with NaN, " +
                           std::to_string(counts.infinite) + " with Inf, " + std::to_string(counts.negative) +
                           " negative";
        if (counts.non_finite() > 0) text += "; NaN and Inf are left out of every metric";
        if (counts.non_finite() > 0 && comparison.options.fail_on_non_finite)
            fail(text.substr(0, text.find(';')), "; NaN and Inf must not occur");
        comparison.warnings.push_back(text);
    };
    report(comparison.reference_counts, comparison.options.reference);
    report(comparison.test_counts, comparison.options.test);
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

void check(const CompareOptions& options) {
    for (const std::string& name : options.metrics) metric_named(name);
    if (!options.map.empty() && lower_case_extension(options.map) != ".exr" &&
        lower_case_extension(options.map) != ".png")
        fail("cannot write the error map ", options.map.string(), ": its name must end in .exr or .png");
    if (!(options.map_max > 0)) fail("the scale of the error map is ", options.map_max, ", but must be above 0");
}

}  // namespace

Comparison compare(const CompareOptions& options) {
    check(options);
    Comparison comparison{.options = options};
    Source reference = read_source(options.reference, options, comparison.warnings);
    constexpr double bytes_per_pixel = 300;  // of both images and all maps, as measured with the default metrics
    MemoryShare memory;
    memory.add(double(reference.linear.pixel_count()) * bytes_per_pixel,
               options.reference.string() + ": the comparison of its " +
                   std::to_string(reference.linear.pixel_count()) + " pixels");
    Source test = read_source(options.test, options, comparison.warnings);
    if (reference.linear.extent != test.linear.extent)
        fail(options.reference.string(), " has ", reference.linear.extent.x, "x", reference.linear.extent.y,
             " pixels, but ", options.test.string(), " has ", test.linear.extent.x, "x", test.linear.extent.y,
             ": both must be of one size");
    for (Source* source : {&reference, &test})  // of which the memory is set aside
        if (source->is_radiance)
            source->codes = display_codes(source->linear, options.settings.exposure_ev, options.settings.tone_map);
    comparison.extent = reference.linear.extent;
    comparison.reference_counts = count_bad_pixels(reference.linear);
    comparison.test_counts = count_bad_pixels(test.linear);
    report_bad_pixels(comparison);

    choose_flip_exposures(comparison, reference);
    CompareOptions& used = comparison.options;
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
    if (!options.map.empty()) write_map(used, comparison.results);
    return comparison;
}

void print(const Comparison& comparison, std::ostream& out, std::ostream& warnings) {
    for (const std::string& warning : comparison.warnings) warnings << "warning: " << shown_text(warning) << '\n';
    for (const CompareResult& result : comparison.results)
        out << result.metric->name << ' ' << shortest_digits(result.value) << '\n';
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
