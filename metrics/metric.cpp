#include "metrics/metric.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/png.h"
#include "metrics/cvvdp_metric.h"
#include "metrics/pixel_metrics.h"
#include "metrics/pooling.h"
#include "metrics/pu21.h"
#include "metrics/ssim.h"
#include "metrics/temporal.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace {

HostImage decoded(const HostImage& codes) {
    HostImage linear = codes;
    tbb::parallel_for(size_t(0), size_t(codes.extent.y), [&](size_t y) {
        const size_t row = size_t(codes.extent.x) * 3;
        for (size_t i = y * row; i < (y + 1) * row; ++i) linear.values[i] = linear_from_srgb(codes.values[i]);
    });
    return linear;
}

std::vector<Plane> flip_layers(const ImagePair& pair) {
    return {flip_map(decoded(pair.reference_codes), decoded(pair.test_codes), pair.settings.pixels_per_degree)};
}

std::vector<Plane> hdr_flip_layers(const ImagePair& pair) {
    if (!pair.settings.flip_exposures)
        fail("hdr_flip needs a range of exposures, taken once from the scene's full reference image");
    return {hdr_flip_map(pair.reference, pair.test, *pair.settings.flip_exposures, pair.settings.hdr_flip_tone_map,
                         pair.settings.pixels_per_degree)};
}

std::vector<Metric> make_table() {
    std::vector<Metric> table = pixel_metrics();
    const size_t first_of_most_one = table.size();  // a similarity, or an error that an eye can see
    for (Metric& metric : ssim_metrics()) table.push_back(std::move(metric));
    table.push_back({"flip", "flip_ldr", "1", Better::lower,
                     "Mean of LDR-FLIP, the difference that a viewer notices, sRGB codes (Andersson et al. 2020)",
                     flip_layers, pooled_mean});
    table.push_back({"hdr_flip", "flip_hdr", "1", Better::lower,
                     "Mean of the greatest LDR-FLIP over a range of exposures that is fixed for each scene, linear "
                     "radiance (Andersson et al. 2021)",
                     hdr_flip_layers, pooled_mean});
    for (Metric& metric : std::span(table).subspan(first_of_most_one)) metric.greatest = 1;
    for (Metric& metric : pu21_metrics()) table.push_back(std::move(metric));
    table.push_back(cvvdp_metric());
    return table;
}

bool is_finite(glm::vec3 c) { return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z); }

void check(const HostImage& reference, const HostImage& test) {
    if (reference.extent != test.extent)
        fail("the reference has ", reference.extent.x, "x", reference.extent.y, " pixels, but the test image has ",
             test.extent.x, "x", test.extent.y, ": both must be of one size");
    if (reference.pixel_count() == 0) fail("cannot measure images of zero size");
    for (const HostImage* image : {&reference, &test})
        if (image->channels != 3)
            fail("cannot measure an image of ", image->channels, " channels: metrics need the three of a colour");
}

/// Without codes: all but reference_codes and test_codes.
ImagePair linear_pair(const HostImage& reference, const HostImage& test, const MetricSettings& settings) {
    check(reference, test);
    ImagePair pair{.reference = reference, .test = test, .settings = settings};
    pair.reference_counts = count_bad_pixels(reference);
    pair.test_counts = count_bad_pixels(test);
    pair.finite = full_mask(reference.extent);
    for (size_t i = 0; i < reference.pixel_count(); ++i)
        if (!is_finite(reference.rgb(i)) || !is_finite(test.rgb(i))) {
            pair.finite.inside[i] = 0;
            pair.reference.set_rgb(i, glm::vec3(0));
            pair.test.set_rgb(i, glm::vec3(0));
        }
    return pair;
}

}  // namespace

const std::vector<Metric>& all_metrics() {
    static const std::vector<Metric> table = make_table();
    return table;
}

std::vector<std::string> metric_names() { return names_of(all_metrics(), &Metric::name); }

/// Metrics that configs may name and that are gone, with what tells the same.
static const std::map<std::string, std::string>& replaced_metrics() {
    static const std::map<std::string, std::string> all = {
        {"relmse_b", "relmse"}, {"relmse_c", "relmse"}, {"ssim_sample", "ssim"}, {"ms_ssim", "ssim"}};
    return all;
}

const Metric& metric_named(const std::string& name) {
    const auto found = std::ranges::find(all_metrics(), name, &Metric::name);
    if (const auto instead = replaced_metrics().find(name); instead != replaced_metrics().end())
        fail("there is no metric '", name, "'; use ", instead->second);
    if (found == all_metrics().end() && find_temporal_metric(name))
        fail("'", name, "' is of several frames: studies measure it in shots that have them, without being asked. ",
             "`ssrlab compare` scores two videos by cvvdp_0_5_6, of frames that a pattern names: frame_####.exr");
    if (found == all_metrics().end()) fail("no metric named '", name, "'", suggestion(name, metric_names()));
    return *found;
}

double measure(const Metric& metric, const ImagePair& pair, const Mask* mask) {
    const std::vector<Plane> layers = metric.layers(pair);
    return metric.pool(layers, mask ? intersection(*mask, pair.finite) : pair.finite);
}

PixelCounts count_bad_pixels(const HostImage& rgb) {
    PixelCounts counts;
    for (size_t i = 0; i < rgb.pixel_count(); ++i) {
        const glm::vec3 c = rgb.rgb(i);
        if (std::isnan(c.x) || std::isnan(c.y) || std::isnan(c.z))
            ++counts.nan;
        else if (!is_finite(c))
            ++counts.infinite;
        else if (std::min({c.x, c.y, c.z}) < 0)
            ++counts.negative;
    }
    return counts;
}

ImagePair image_pair(const HostImage& reference, const HostImage& test, const MetricSettings& settings) {
    ImagePair pair = linear_pair(reference, test, settings);
    pair.reference_codes = display_codes(pair.reference, settings.exposure_ev, settings.tone_map);
    pair.test_codes = display_codes(pair.test, settings.exposure_ev, settings.tone_map);
    return pair;
}

ImagePair image_pair(const HostImage& reference, const HostImage& test, const HostImage& reference_codes,
                     const HostImage& test_codes, const MetricSettings& settings) {
    ImagePair pair = linear_pair(reference, test, settings);
    check(reference, reference_codes);
    check(test, test_codes);
    pair.reference_codes = reference_codes;
    pair.test_codes = test_codes;
    for (size_t i = 0; i < reference.pixel_count(); ++i)
        if (!pair.finite.inside[i]) {
            pair.reference_codes.set_rgb(i, glm::vec3(0));
            pair.test_codes.set_rgb(i, glm::vec3(0));
        }
    return pair;
}

Mask full_mask(glm::uvec2 extent) {
    return {.name = "all", .extent = extent, .inside = std::vector<uint8_t>(size_t(extent.x) * extent.y, 1)};
}

Mask intersection(const Mask& a, const Mask& b) {
    if (a.extent != b.extent)
        fail("the mask '", a.name, "' has ", a.extent.x, "x", a.extent.y, " pixels, but '", b.name, "' has ",
             b.extent.x, "x", b.extent.y);
    Mask both = a;
    for (size_t i = 0; i < both.inside.size(); ++i) both.inside[i] = a.inside[i] && b.inside[i];
    return both;
}
