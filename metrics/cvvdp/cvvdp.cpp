#include "metrics/cvvdp/cvvdp.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "metrics/cvvdp/temporal_filters.h"

#include <tbb/parallel_for.h>
#include <algorithm>

namespace {

void check(const HostImage& reference, const HostImage& test, glm::uvec2 extent) {
    for (const HostImage* image : {&reference, &test}) {
        if (image->extent != extent)
            fail("an image has ", image->extent.x, "x", image->extent.y, " pixels, but others have ", extent.x, "x",
                 extent.y, ": all must be of one size");
        if (image->channels != 3)
            fail("cannot measure an image of ", image->channels, " channels: cvvdp needs the three of a colour");
    }
}

void check(const Viewing& viewing) {
    if (viewing.display.transfer == Transfer::linear && !(viewing.nits_per_unit > 0 && viewing.nits_per_unit <= 1e9))
        fail("a radiance of 1 would be shown with ", viewing.nits_per_unit,
             " cd/m2, which is outside (0, 1e9]; change --nits-per-unit or --exposure");
}

FrameChannels frame_channels(glm::uvec2 extent, unsigned channels) {
    return {float_planes(channels, extent.x, extent.y), float_planes(channels, extent.x, extent.y)};
}

void add_jod_map(const FloatPlane& pooled, const CvvdpCalibration& calibration, Plane& map) {
    if (map.values.empty()) map = Plane({pooled.width, pooled.height});
    tbb::parallel_for(0u, pooled.height, [&](unsigned y) {
        for (unsigned x = 0; x < pooled.width; ++x) map.row(y)[x] += 10 - jod(pooled.row(y)[x], calibration);
    });
}

void add_weighted(const float* __restrict in, float weight, float* __restrict out, unsigned width) {
    for (unsigned x = 0; x < width; ++x) out[x] += weight * in[x];
}

}  // namespace

CvvdpStills::CvvdpStills(glm::uvec2 extent, const Viewing& viewing, const CvvdpCalibration& calibration)
    : extent_(extent),
      viewing_(viewing),
      calibration_(calibration),
      comparison_(extent, viewing.display.pixels_per_degree, opponent_channels, calibration),
      channels_(frame_channels(extent, opponent_channels)) {
    check(viewing);
}

CvvdpScore CvvdpStills::score(const HostImage& reference, const HostImage& test, bool has_map) {
    check(reference, test, extent_);
    CvvdpScore score;
    score.non_finite = to_opponent(reference, test, viewing_, channels_[1], channels_[0]);
    FloatPlane map;
    score.frames.push_back(comparison_.compare(channels_, has_map ? &map : nullptr));
    if (has_map) add_jod_map(map, calibration_, score.map);
    score.jod = jod(pooled_difference(score.frames, opponent_channels, true, calibration_), calibration_);
    return score;
}

TemporalPadding temporal_padding_named(const std::string& name) {
    const auto found = std::ranges::find(temporal_padding_names, name);
    if (found == temporal_padding_names.end())
        fail("no padding named '", name, "'", suggestion(name, temporal_padding_names));
    return TemporalPadding(found - temporal_padding_names.begin());
}

std::string name_of(TemporalPadding padding) { return temporal_padding_names.at(size_t(padding)); }

double video_bytes_per_pixel(double frames_per_second) { return 24.0 * filter_window(frames_per_second) + 100; }

CvvdpVideo::CvvdpVideo(glm::uvec2 extent, const Viewing& viewing, double frames_per_second, TemporalPadding padding,
                       bool has_map, const CvvdpCalibration& calibration)
    : extent_(extent),
      viewing_(viewing),
      padding_(padding),
      has_map_(has_map),
      calibration_(calibration),
      filters_(temporal_filters(frames_per_second, calibration)),
      comparison_(extent, viewing.display.pixels_per_degree, cvvdp_channels, calibration),
      channels_(frame_channels(extent, cvvdp_channels)) {
    check(viewing);
}

void CvvdpVideo::remember(const HostImage& reference, const HostImage& test) {
    check(reference, test, extent_);
    const size_t slot = count_ % window();
    if (slot == window_.size()) window_.push_back(frame_channels(extent_, opponent_channels));
    score_.non_finite += to_opponent(reference, test, viewing_, window_[slot][1], window_[slot][0]);
    ++count_;
}

void CvvdpVideo::add(const HostImage& reference, const HostImage& test) {
    remember(reference, test);
    if (count_ < window() && padding_ != TemporalPadding::replicate) return;
    // A mirrored start shows the second frame and later ones, so frames wait until the first window is full.
    const size_t first = count_ == window() && padding_ == TemporalPadding::symmetric ? 0 : count_ - 1;
    for (size_t frame = std::max(first, earlier_); frame < count_; ++frame) pool(frame);
}

void CvvdpVideo::add_earlier(const HostImage& reference, const HostImage& test) {
    if (count_ > earlier_) fail("earlier frames of a video must be added before those that are scored");
    remember(reference, test);
    ++earlier_;
}

/// The frame that is seen at a time, which may be before the first.
size_t CvvdpVideo::shown_at(int64_t frame) const {
    if (frame >= 0) return size_t(frame);
    if (padding_ == TemporalPadding::replicate || count_ == 1) return 0;
    const size_t period = 2 * (count_ - 1), mirrored = size_t(-frame) % period;
    return mirrored < count_ ? mirrored : period - mirrored;
}

void CvvdpVideo::pool(size_t frame) {
    std::vector<size_t> slots;
    for (unsigned j = 0; j < window(); ++j) slots.push_back(shown_at(int64_t(frame) - j) % window());
    constexpr unsigned source[cvvdp_channels] = {0, 1, 2, 0};  // the opponent channel that each is a filtered one of
    tbb::parallel_for(0u, extent_.y, [&](unsigned y) {
        for (int image = 0; image < 2; ++image)
            for (unsigned c = 0; c < cvvdp_channels; ++c) {
                float* out = channels_[image][c].row(y);
                std::fill_n(out, extent_.x, 0.0f);
                for (unsigned j = 0; j < window(); ++j)
                    add_weighted(window_[slots[j]][image][source[c]].row(y), filters_[c][j], out, extent_.x);
            }
    });
    FloatPlane map;
    std::vector<BandStages> stages;
    score_.frames.push_back(
        comparison_.compare(channels_, has_map_ || on_frame ? &map : nullptr, on_frame ? &stages : nullptr));
    if (has_map_) add_jod_map(map, calibration_, score_.map);
    if (on_frame) on_frame(frame, channels_, stages, map);
}

CvvdpScore CvvdpVideo::score() {
    if (count_ < 2) fail("a video needs at least two frames, but has ", count_, ": compare one frame as a still");
    if (count_ < window() && padding_ == TemporalPadding::warm_up)
        fail("the filters over time need ", window(), " frames before one can be scored, but there are ", count_,
             ": give more frames, or choose another padding");
    if (count_ < window() && padding_ == TemporalPadding::symmetric && score_.frames.empty())
        for (size_t frame = earlier_; frame < count_; ++frame) pool(frame);
    score_.jod = jod(pooled_difference(score_.frames, cvvdp_channels, false, calibration_), calibration_);
    for (double& v : score_.map.values) v /= double(score_.frames.size());
    return std::move(score_);
}
