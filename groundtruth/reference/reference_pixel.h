#pragma once
#include "groundtruth/paths/path_tracer.h"
#include "groundtruth/reference/reference.h"

#include <functional>
#include <span>

/// What a pass needs of the path tracer. Tests replace it by integrands with known moments. `first_hit` and `trace` are
/// called from any thread; `trace` is PathTracer::trace() of several batches. `expect`, if given, is
/// PathTracer::expect().
struct PixelTracer {
    std::function<FirstHit(unsigned x, unsigned y)> first_hit;
    std::function<void(unsigned x, unsigned y, const FirstHit& hit, unsigned first_sample, unsigned count,
                       std::span<SampleBatch> batches, Directions directions)>
        trace;
    std::function<void(const HostImage& diffuse, const HostImage& specular)> expect = {};
};

/// `path_tracer` must outlive the result.
PixelTracer pixel_tracer(PathTracer& path_tracer);

inline constexpr unsigned batch_count = 16;  ///< per pass; the even ones make half A, the odd ones half B

struct PixelCost {
    uint64_t rays = 0, non_finite = 0;
};

/// The independent sets of samples that passes draw from.
enum class SampleSet : uint64_t { reference, guide };

/// The samples to add to a pixel.
struct SampleRequest {
    uint64_t seed = 0;
    SampleSet set = SampleSet::reference;
    unsigned batch_samples = 1;  ///< in each of batch_count batches
    Directions directions;       ///< of each sample
    uint64_t most_lit = 0;  ///< samples of `diffuse` that the pixel may have, a multiple of batch_count; 0: no limit
};

/// Adds samples to one pixel in all outputs of `reference`, and writes its first-hit layers. Scrambles depend on seed,
/// set and the pixel's number of samples so far, but not on threads or time.
PixelCost add_samples(Reference& reference, const PixelTracer& tracer, unsigned x, unsigned y,
                      const SampleRequest& request);
