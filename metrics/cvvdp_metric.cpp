#include "metrics/cvvdp_metric.h"

#include "metrics/cvvdp/cvvdp.h"

#include <limits>

namespace {

/// The map of differences in JOD, and the score as a plane of one pixel.
std::vector<Plane> cvvdp_layers(const ImagePair& pair) {
    const bool is_coded = pair.settings.viewing.display.transfer == Transfer::srgb;
    CvvdpStills stills(pair.reference.extent, exposed_viewing(pair.settings));
    CvvdpScore score = stills.score(is_coded ? pair.reference_codes : pair.reference,
                                    is_coded ? pair.test_codes : pair.test, /*has_map=*/true);
    Plane jod({1, 1});
    jod.values[0] = score.jod;
    return {std::move(score.map), std::move(jod)};
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
            .greatest = 10,
            .is_of_display = true};
}
