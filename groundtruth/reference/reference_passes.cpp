#include "groundtruth/reference/reference_passes.h"

#include "core/elapsed.h"
#include "groundtruth/reference/adaptive_directions.h"
#include "groundtruth/reference/reference_stopping.h"
#include "groundtruth/sampling/flush_denormals.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>

namespace {

constexpr double largest_overrun = 1.05;  ///< of a time limit
constexpr unsigned tile_size = 8;         ///< pixels; neighbours meet the same nodes of the BVH

/// What samples take, in samples of a mean pixel: about as many as they have directions.
class SampleCosts {
public:
    explicit SampleCosts(const HostImage& directions) : directions_(directions) {
        if (directions.values.empty()) return;
        const double sum = std::accumulate(directions.values.begin(), directions.values.end(), 0.0);
        mean_ = sum / double(directions.pixel_count());
    }
    double of(size_t pixel) const {
        const Directions directions = directions_of(directions_, pixel);
        return (directions.diffuse + directions.specular) / mean_;
    }

private:
    const HostImage& directions_;
    double mean_ = 2;
};

struct Tile {
    unsigned x, y;
    double samples;  ///< to be done, of a mean pixel
};

/// The tiles with work left; those with most first, so that no thread is left alone with one at the end.
std::vector<Tile> unfinished_tiles(const ReferenceState& state, const SampleCosts& costs) {
    const glm::uvec2 extent = state.reference.extent;
    const std::vector<float>& count = state.reference.sample_count.values;
    std::vector<Tile> tiles;
    for (unsigned y = 0; y < extent.y; y += tile_size)
        for (unsigned x = 0; x < extent.x; x += tile_size) {
            Tile tile{x, y, 0};
            for (unsigned j = y; j < std::min(y + tile_size, extent.y); ++j)
                for (unsigned i = x; i < std::min(x + tile_size, extent.x); ++i) {
                    const size_t pixel = size_t(j) * extent.x + i;
                    tile.samples += (double(state.sample_goal.values[pixel]) - count[pixel]) * costs.of(pixel);
                }
            if (tile.samples > 0) tiles.push_back(tile);
        }
    std::ranges::stable_sort(tiles, std::ranges::greater{}, &Tile::samples);
    return tiles;
}

/// What all threads of a pass share.
struct PassCounts {
    double samples_before;  ///< of all pixels
    const SampleCosts& costs;
    RenderClock::Instant start = std::chrono::steady_clock::now();
    std::atomic<uint64_t> rays = 0, non_finite = 0;
    std::atomic<double> samples = 0;  ///< of a mean pixel
    std::atomic<bool> pause = false, is_late = false;
    std::mutex looks_at_clock;
};

void report(const PassCounts& counts, const RenderClock& clock, const Reference& reference) {
    const double rays = reference.rays + double(counts.rays) - clock.rays_before;
    const double done = counts.samples_before + counts.samples;
    const double made = done - counts.samples_before;
    double left = (clock.all_samples - done) / std::max(made, 1.0) * seconds_since(counts.start);
    double fraction = done / clock.all_samples;
    if (clock.time_limit > 0) {
        left = std::clamp(clock.time_limit - clock.seconds(), 0.0, left);
        fraction = std::max(fraction, clock.seconds() / clock.time_limit);
    }
    clock.run.progress(std::min(fraction, 1.0), rays / std::max(seconds_since(clock.start), 1e-9), left);
}

/// Called by every thread after each pixel; one at a time looks at the clock.
void look_at_clock(PassCounts& counts, RenderClock& clock, const Reference& reference) {
    const std::unique_lock lock(counts.looks_at_clock, std::try_to_lock);
    if (!lock) return;
    const double save_interval = std::max(clock.run.seconds_between_saves, 20 * clock.save_seconds);
    if (!clock.run.state_file.empty() && seconds_since(clock.last_save) > save_interval) counts.pause = true;
    if (clock.cuts_pass && clock.time_limit > 0 && clock.seconds() > largest_overrun * clock.time_limit)
        counts.pause = counts.is_late = true;
    if (!clock.run.progress || seconds_since(clock.last_report) < clock.run.seconds_between_reports) return;
    clock.last_report = std::chrono::steady_clock::now();
    report(counts, clock, reference);
}

void render_tile(ReferenceState& state, const PixelTracer& tracer, const Tile& tile, PassCounts& counts,
                 RenderClock& clock) {
    Reference& reference = state.reference;
    for (unsigned y = tile.y; y < std::min(tile.y + tile_size, reference.extent.y); ++y)
        for (unsigned x = tile.x; x < std::min(tile.x + tile_size, reference.extent.x); ++x) {
            if (counts.pause) return;
            const size_t pixel = size_t(y) * reference.extent.x + x;
            const unsigned samples = unsigned(state.sample_goal.values[pixel] - reference.sample_count.values[pixel]);
            if (samples == 0) continue;
            const PixelCost cost = add_samples(reference, tracer, x, y,
                                               {.seed = state.settings.seed,
                                                .batch_samples = samples / batch_count,
                                                .directions = directions_of(reference.directions, pixel),
                                                .most_lit = lit_sample_limit(state.settings)});
            if (!state.rays_per_sample.values.empty())
                state.rays_per_sample.values[pixel] = float(double(cost.rays) / samples);
            counts.rays += cost.rays;
            counts.non_finite += cost.non_finite;
            counts.samples += samples * counts.costs.of(pixel);
            look_at_clock(counts, clock, reference);
        }
}

void save(ReferenceState& state, RenderClock& clock) {
    if (clock.run.state_file.empty()) return;
    const auto start = std::chrono::steady_clock::now();
    state.reference.seconds = clock.seconds();
    write_reference_state(clock.run.state_file, state);
    clock.save_seconds = seconds_since(start);
    clock.last_save = std::chrono::steady_clock::now();
}

}  // namespace

double RenderClock::seconds() const { return seconds_before + seconds_since(start); }

double RenderClock::seconds_per_ray(const Reference& reference) const {
    return pass_rays > 0 ? pass_seconds / pass_rays : seconds() / std::max(reference.rays, 1.0);
}

double total_samples(const Reference& reference) {
    const std::vector<float>& counts = reference.sample_count.values;
    return std::accumulate(counts.begin(), counts.end(), 0.0);
}

ReferenceState empty_state(glm::uvec2 extent, const ReferenceSettings& settings) {
    ReferenceState state{.reference = {}, .settings = settings};
    Reference& reference = state.reference;
    reference.extent = extent;
    const auto clear = [&](ReferenceOutput& output) {
        for (HostImage* image : {&output.mean, &output.half_a, &output.half_b, &output.variance})
            *image = HostImage(extent, 3);
    };
    clear(reference.diffuse);
    if (!settings.lit_only)
        for (ReferenceOutput* output : {&reference.image, &reference.specular, &reference.incident}) clear(*output);
    for (HostImage* image : {&reference.highlights, &reference.geometric_normal, &reference.normal})
        *image = HostImage(extent, 3);
    for (HostImage* image : {&reference.cut_share, &reference.sample_count, &reference.depth, &reference.material_id})
        *image = HostImage(extent, 1);
    reference.lobe_samples = HostImage(extent, 2);
    if (settings.ladder) {
        TruthLadder& ladder = reference.ladder;
        for (ReferenceOutput* output : {&ladder.camera_radiance, &ladder.on_screen}) clear(*output);
        for (HostImage* image : {&ladder.reflectance, &ladder.fallback, &ladder.camera_radiance_error.incident,
                                 &ladder.camera_radiance_error.specular, &ladder.on_screen_error.incident,
                                 &ladder.on_screen_error.specular})
            *image = HostImage(extent, 3);
        ladder.on_screen_share = HostImage(extent, 1);
    }
    return state;
}

void render_pass(ReferenceState& state, const PixelTracer& tracer, RenderClock& clock) {
    const SampleCosts costs(state.reference.directions);
    for (;;) {
        const std::vector<Tile> tiles = unfinished_tiles(state, costs);
        if (tiles.empty()) return;
        PassCounts counts{.samples_before = total_samples(state.reference), .costs = costs};
        std::atomic<size_t> next = 0;
        const auto work = [&](int) {
            const FlushDenormals flush;
            for (size_t tile; !counts.pause && (tile = next++) < tiles.size();)
                render_tile(state, tracer, tiles[tile], counts, clock);
        };
        const auto add_counts = [&] {
            clock.pass_seconds = seconds_since(counts.start), clock.pass_rays = double(counts.rays);
            state.reference.rays += double(counts.rays);
            state.reference.non_finite_samples += counts.non_finite;
        };
        try {
            tbb::parallel_for(0, tbb::this_task_arena::max_concurrency(), work, tbb::simple_partitioner());
        } catch (...) {
            add_counts();
            save(state, clock);
            throw;
        }
        add_counts();
        if (counts.is_late) {
            state.sample_goal = state.reference.sample_count;
            return;
        }
        if (counts.pause) save(state, clock);
    }
}
