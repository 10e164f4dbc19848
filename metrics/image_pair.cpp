#include "core/error.h"
#include "core/png.h"
#include "metrics/metric.h"

#include <algorithm>
#include <cmath>

namespace {

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
