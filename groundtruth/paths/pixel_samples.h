#pragma once
#include "groundtruth/paths/path_tracer.h"
#include "groundtruth/sampling/lanes.h"
#include "groundtruth/sampling/sobol.h"

#include <cstdint>
#include <span>
#include <vector>

/// At most one sample per lane.
struct SampleLanes {
    int count = 0;
    Lanes<uint32_t> seed_a, seed_b;  ///< of each one's sequence
    Lanes<uint32_t> reversed_sample;
    PixelEstimate* estimate[lane_count] = {};

    SobolSequence sequence(int lane) const { return {seed_a[lane], seed_b[lane]}; }
};

/// The same samples of each batch of a pixel, by lanes. Samples of one batch follow those of another, so that small
/// batches fill the lanes together.
class PixelSamples {
public:
    PixelSamples(unsigned x, unsigned y, unsigned first, unsigned count, std::span<SampleBatch> batches)
        : pixel_(uint64_t(y) << 32 | x), first_(first), count_(count), batches_(batches) {}

    std::span<SampleBatch> batches() const { return batches_; }
    PixelSamples with(std::span<SampleBatch> batches) const {
        PixelSamples samples = *this;
        samples.batches_ = batches;
        return samples;
    }
    /// New batches of the same seeds.
    std::vector<SampleBatch> empty_batches() const {
        std::vector<SampleBatch> empty;
        for (const SampleBatch& batch : batches_) empty.push_back({.seed = batch.seed, .estimate = {}});
        return empty;
    }

    template <class Work>
    void for_each_lanes(const Work& work) const {
        SampleLanes lanes;
        for (SampleBatch& batch : batches_) {
            const SobolSequence sequence(batch.seed ^ hash_bits_64(pixel_));
            for (unsigned sample = first_; sample < first_ + count_; ++sample) {
                lanes.seed_a[lanes.count] = sequence.seed_a, lanes.seed_b[lanes.count] = sequence.seed_b;
                lanes.reversed_sample[lanes.count] = reverse_bits(sample);
                lanes.estimate[lanes.count] = &batch.estimate;
                if (++lanes.count < lane_count) continue;
                work(lanes);
                lanes.count = 0;
            }
        }
        if (lanes.count > 0) work(lanes);
    }

private:
    uint64_t pixel_;
    unsigned first_, count_;
    std::span<SampleBatch> batches_;
};
