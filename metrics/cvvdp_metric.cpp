#include "metrics/cvvdp_metric.h"

#include "metrics/cvvdp/cvvdp.h"
#include "metrics/jod_interval.h"

#include <algorithm>
#include <limits>

namespace {

/// The map of differences in JOD, the score as a plane of one pixel, and what it is pooled from: a row for each band, a
/// column for each channel.
std::vector<Plane> cvvdp_layers(const ImagePair& pair) {
    const bool is_coded = pair.settings.viewing.display.transfer == Transfer::srgb;
    CvvdpStills stills(pair.reference.extent, exposed_viewing(pair.settings));
    CvvdpScore score = stills.score(is_coded ? pair.reference_codes : pair.reference,
                                    is_coded ? pair.test_codes : pair.test, /*has_map=*/true);
    Plane jod({1, 1});
    jod.values[0] = score.jod;
    const VisibleDifferences& differences = score.frames.front();
    Plane bands({cvvdp_channels, unsigned(differences.size())});
    for (unsigned band = 0; band < bands.extent.y; ++band) std::ranges::copy(differences[band], bands.row(band));
    return {std::move(score.map), std::move(jod), std::move(bands)};
}

std::vector<VisibleDifferences> differences_of(std::span<const Plane> layers) {
    const Plane& bands = layers[2];
    VisibleDifferences differences(bands.extent.y);
    for (unsigned band = 0; band < bands.extent.y; ++band)
        std::copy_n(bands.row(band), cvvdp_channels, differences[band].begin());
    return {std::move(differences)};
}

std::optional<Interval> cvvdp_interval(const std::array<std::span<const Plane>, 3>& layers,
                                       const ReferenceHalves& halves, const MetricSettings& settings) {
    if (relative_noise(halves.a, halves.b, exposed_viewing(settings)) > most_noise_of_jod) return {};
    const auto& [truth, half_a, half_b] = layers;
    return jod_interval({differences_of(truth), differences_of(half_a), differences_of(half_b)}, /*is_still=*/true).jod;
}

/// Bands reach over the whole image and are pooled by more than a mean, so no other mask has a score.
double score_of_all(std::span<const Plane> layers, const Mask& mask) {
    if (mask.name != "all" || mask.count() == 0) return std::numeric_limits<double>::quiet_NaN();
    return layers[1].values[0];
}

}  // namespace

Viewing exposed_viewing(const MetricSettings& settings) {
    Viewing viewing = settings.viewing;
    viewing.nits_per_unit *= std::exp2(settings.exposure_ev);
    return viewing;
}

Metric cvvdp_metric() {
    return {.name = "cvvdp_0_5_6",
            .formula = "colorvideovdp_0.5.6",
            .unit = "JOD",
            .better = Better::higher,
            .doc =
                "ColorVideoVDP 0.5.6 of stills, of the whole image: 10 for no visible difference, and one less where "
                "75 % of observers prefer the other image; linear radiance with 203 cd/m2 x 2^exposure for 1, on the "
                "display standard_hdr_linear (Mantiuk et al. 2024)",
            .layers = cvvdp_layers,
            .pool = score_of_all,
            .noise_interval = cvvdp_interval,
            .greatest = 10,
            .is_of_display = true};
}
