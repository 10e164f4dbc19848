#include "metrics/cvvdp/frame_comparison.h"

#include "metrics/cvvdp/pyramid.h"

#include <tbb/parallel_for.h>

FrameComparison::FrameComparison(glm::uvec2 extent, double pixels_per_degree, unsigned channels,
                                 const CvvdpCalibration& calibration)
    : calibration_(calibration), is_still_(channels < cvvdp_channels) {
    const std::vector<double> frequencies = band_frequencies(extent, pixels_per_degree);
    for (size_t b = 0; b < frequencies.size(); ++b)
        bands_.push_back({.sensitivity = BandSensitivity(frequencies[b], calibration),
                          .is_doubled = b > 0 && b + 1 < frequencies.size()});
    for (const glm::uvec2 size : coarser_sizes(extent, unsigned(bands_.size()) - 1))
        coarser_levels_.push_back({float_planes(channels, size.x, size.y), float_planes(channels, size.x, size.y)});
}

VisibleDifferences FrameComparison::compare(const FrameChannels& frame, FloatPlane* map,
                                            std::vector<BandStages>* stages) {
    const size_t base = bands_.size() - 1;
    const auto level = [&](size_t b) -> const FrameChannels& { return b == 0 ? frame : coarser_levels_[b - 1]; };
    for (size_t b = 0; b < base; ++b)
        for (int image = 0; image < 2; ++image)
            for (size_t c = 0; c < frame[image].size(); ++c) reduce(level(b)[image][c], coarser_levels_[b][image][c]);

    if (stages) stages->assign(bands_.size(), {});
    std::vector<FloatPlane> maps;
    VisibleDifferences differences;
    for (size_t b = 0; b <= base; ++b) {
        PerCvvdpChannel<double> map_weights = calibration_.channel_weights;
        for (unsigned c = 0; c < cvvdp_channels; ++c)
            map_weights[c] *=
                (is_still_ ? calibration_.still_weight : 1) * (b == base ? calibration_.base_band_weights[c] : 1);
        BandLevels levels{.test = level(b)[0], .reference = level(b)[1]};
        if (map) maps.emplace_back(levels.test[0].width, levels.test[0].height);
        FloatPlane* band_map = map ? &maps.back() : nullptr;
        BandStages* band_stages = stages ? &(*stages)[b] : nullptr;
        if (b == base) {
            differences.push_back(
                base_band_difference(levels, bands_[b], calibration_, map_weights, band_map, band_stages));
        } else {
            levels.coarser_test = level(b + 1)[0], levels.coarser_reference = level(b + 1)[1];
            differences.push_back(band_difference(levels, bands_[b], calibration_, map_weights, band_map, band_stages));
        }
    }
    if (map) *map = collapsed(std::move(maps));
    return differences;
}

/// Adds the bands from the coarsest to the finest, each level enlarged to the size of the next.
FloatPlane FrameComparison::collapsed(std::vector<FloatPlane> bands) const {
    for (size_t b = bands.size() - 1; b-- > 0;) {
        const float weight = bands_[b].is_doubled ? 0.5f : 1.0f;
        FloatPlane& fine = bands[b];
        tbb::parallel_for(0u, fine.height, [&](unsigned y) {
            std::vector<float> coarse(fine.width), scratch;
            expand_row(bands[b + 1], y, coarse.data(), fine.width, scratch);
            for (unsigned x = 0; x < fine.width; ++x) fine.row(y)[x] = weight * fine.row(y)[x] + coarse[x];
        });
    }
    return std::move(bands.front());
}
