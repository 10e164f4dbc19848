#include "metrics/pu21.h"

#include "metrics/cvvdp_metric.h"
#include "metrics/pooling.h"
#include "metrics/ssim.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace {

/// The code of 100 cd/m2, the white of a display for which 8-bit codes were made. Metrics take it as the range of
/// codes.
constexpr double white = 256;

/// Each channel's light, by MetricSettings::viewing.
HostImage pu21_codes(const HostImage& radiance, const HostImage& srgb_codes, const Viewing& viewing) {
    HostImage codes = viewing.display.transfer == Transfer::linear ? radiance : srgb_codes;
    tbb::parallel_for(0u, codes.extent.y, [&](unsigned y) {
        float* const row = codes.pixel(0, y);
        const size_t count = size_t(codes.extent.x) * codes.channels;
        displayed_light(viewing, row, row, count);
        for (size_t i = 0; i < count; ++i) row[i] = float(pu21_code(double(row[i])));
    });
    return codes;
}

struct CodedPair {
    HostImage reference, test;
};

CodedPair coded(const ImagePair& pair) {
    const Viewing viewing = exposed_viewing(pair.settings);
    return {pu21_codes(pair.reference, pair.reference_codes, viewing), pu21_codes(pair.test, pair.test_codes, viewing)};
}

std::vector<Plane> code_errors(const ImagePair& pair) {
    const CodedPair codes = coded(pair);
    Plane map(codes.reference.extent);
    for (size_t i = 0; i < map.values.size(); ++i) {
        const glm::dvec3 d = (glm::dvec3(codes.test.rgb(i)) - glm::dvec3(codes.reference.rgb(i))) / white;
        map.values[i] = glm::dot(d, d) / 3;
    }
    return {std::move(map)};
}

std::vector<Plane> code_similarities(const ImagePair& pair) {
    const CodedPair codes = coded(pair);
    return {mean_similarity(codes.reference, codes.test, white)};
}

}  // namespace

double pu21_code(double light) {
    // Constants of the encoding that its authors recommend, fitted to the visibility of banding under glare.
    constexpr double p[] = {0.353487901,   0.3734658629, 8.277049286e-05, 0.9062562627,
                            0.09150303166, 0.9099517204, 596.3148142};
    const double power = std::pow(std::clamp(light, 0.005, 10000.0), p[3]);
    return p[6] * (std::pow((p[0] + p[1] * power) / (1 + p[2] * power), p[4]) - p[5]);
}

std::vector<Metric> pu21_metrics() {
    using enum Better;
    return {
        {.name = "psnr_pu21",
         .formula = "psnr_pu21_banding_glare_channels",
         .unit = "dB",
         .better = higher,
         .doc =
             "-10 log10 of the mean of (d / 256)^2, PU21 codes of the light that a display shows; infinite for equal "
             "images (Mantiuk and Azimi 2021)",
         .layers = code_errors,
         .pool = decibels_of_mean,
         .mean_map = first_layer,
         .of_mean = decibels,
         .is_of_display = true},
        {.name = "ssim_pu21",
         .formula = "ssim_pu21_banding_glare_channels",
         .unit = "1",
         .better = higher,
         .doc = "As ssim, PU21 codes of what standard_hdr_linear shows, with the range 256 (Mantiuk and Azimi 2021)",
         .layers = code_similarities,
         .pool = pooled_mean,
         .greatest = 1,
         .is_of_display = true},
    };
}
