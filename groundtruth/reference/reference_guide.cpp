#include "groundtruth/reference/reference_guide.h"

#include "groundtruth/reference/reference_passes.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <atomic>

namespace {

constexpr uint64_t guide_seed = 0x9d1de;  ///< with a sample set of its own, so that no reference shares its samples
constexpr unsigned band = 16;             ///< rows between two looks at the clock
constexpr unsigned first_samples = batch_count;  ///< of each pixel, for PixelTracer::expect

void render_band(Reference& guide, const PixelTracer& tracer, unsigned first_row, unsigned samples,
                 std::atomic<uint64_t>& rays) {
    const unsigned end = std::min(first_row + band, guide.extent.y), width = guide.extent.x;
    tbb::parallel_for(first_row * width, end * width, [&](unsigned pixel) {
        rays += add_samples(guide, tracer, pixel % width, pixel / width,
                            {.seed = guide_seed, .set = SampleSet::guide, .batch_samples = samples / batch_count})
                    .rays;
    });
}

}  // namespace

RenderedGuide render_guide(const PixelTracer& tracer, glm::uvec2 extent, unsigned samples, const ReferenceRun& run) {
    ReferenceState state = empty_state(extent, {});
    Reference& guide = state.reference;
    const auto start = std::chrono::steady_clock::now();
    auto last_report = start;
    const auto seconds = [](auto from, auto to) { return std::chrono::duration<double>(to - from).count(); };
    std::atomic<uint64_t> rays = 0;
    const auto add_to_all = [&](unsigned held, unsigned added) {
        for (unsigned y = 0; y < extent.y; y += band) {
            render_band(guide, tracer, y, added, rays);
            const auto now = std::chrono::steady_clock::now();
            if (!run.progress || seconds(last_report, now) < run.seconds_between_reports) continue;
            last_report = now;
            const double rows = double(std::min(y + band, extent.y)) / extent.y;
            const double done = (held + rows * added) / samples, spent = std::max(seconds(start, now), 1e-9);
            run.progress(done, double(rays) / spent, spent * (1 - done) / done);
        }
    };
    const unsigned first = tracer.expect ? std::min(first_samples, samples) : samples;
    add_to_all(0, first);
    if (first < samples) {
        tracer.expect(guide.diffuse.mean, guide.specular.mean);
        add_to_all(first, samples - first);
    }
    return {{std::move(guide.specular.mean), std::move(guide.incident.mean), std::move(guide.diffuse.mean)},
            std::move(guide.specular.variance),
            std::move(guide.diffuse.variance),
            std::move(guide.image.mean),
            std::move(guide.material_id)};
}
