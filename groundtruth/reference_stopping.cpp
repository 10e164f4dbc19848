#include "groundtruth/reference_stopping.h"

#include "groundtruth/reference_error.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace {

constexpr uint64_t first_timed_pass = 16;    ///< short, since nothing is known yet of the speed
constexpr uint64_t pilot_samples = 1024;     ///< at most; 16 batches of 64
constexpr double pilot_share = 0.25;         ///< of samples and of time that the pilot may take, at most
constexpr double used_share_of_time = 0.9;   ///< of what is left for the final pass: its cost is only estimated
constexpr uint64_t min_final_samples = 256;  ///< where the pilot asks for less: the other outputs need some

struct Limits {
    uint64_t samples;  ///< per pixel
    double seconds;    ///< 0: unlimited
};

Limits limits(const ReferenceSettings& settings) {
    return {sample_limit(settings), settings.max_seconds};
}

/// Samples per pixel of the next pass of a uniform render that has `held`, or 0 if it is done.
uint64_t next_pass(uint64_t held, Limits limit, double seconds) {
    if (held >= limit.samples) return 0;
    if (limit.seconds == 0)
        return held == 0 ? std::min(first_untimed_pass, limit.samples) : std::min(held, limit.samples - held);
    if (held == 0) return std::min(first_timed_pass, limit.samples);
    // Four times what is there at most, so that a speed misjudged at first is corrected; not less than a 32nd, which
    // would change little.
    const double affordable = (limit.seconds - seconds) * double(held) / seconds;
    const double most = std::min({affordable, 4.0 * double(held), double(limit.samples - held)});
    if (most < batch_count || most < double(held) / 32) return 0;
    return batch_count * std::bit_floor(uint64_t(most) / batch_count);
}

/// Passes over the whole image; all pixels have the same count between them.
void render_uniform(ReferenceState& state, const PixelTracer& tracer, RenderClock& clock, Limits limit) {
    Reference& reference = state.reference;
    clock.phase_start = std::chrono::steady_clock::now();
    clock.phase_samples = double(limit.samples) * double(reference.sample_count.pixel_count());
    clock.phase_samples_before = total_samples(reference);
    clock.time_limit = limit.seconds;
    if (!state.sample_goal.values.empty()) render_pass(state, tracer, clock);  // interrupted within
    while (const uint64_t samples = next_pass(uint64_t(reference.sample_count.values[0]), limit, clock.seconds())) {
        const float goal = reference.sample_count.values[0] + float(samples);
        state.sample_goal = HostImage(reference.extent, 1, goal);
        reference.passes += (reference.passes.empty() ? "" : "+") + std::to_string(samples);
        render_pass(state, tracer, clock);
    }
    state.sample_goal = {};
}

/// The largest variance of one sample of `specular` within the 3x3 pixels of the same material, as a mean over RGB: a
/// pixel whose own samples have missed a rare bright path borrows the doubt of a neighbour that met one.
double neighbourhood_variance(const Reference& reference, unsigned x, unsigned y) {
    const glm::uvec2 extent = reference.extent;
    const float material = *reference.material_id.pixel(x, y);
    double largest = 0;
    for (unsigned j = y ? y - 1 : 0; j <= std::min(y + 1, extent.y - 1); ++j)
        for (unsigned i = x ? x - 1 : 0; i <= std::min(x + 1, extent.x - 1); ++i) {
            if (*reference.material_id.pixel(i, j) != material) continue;
            const float* variance = reference.specular.variance.pixel(i, j);
            const double mean = (double(variance[0]) + variance[1] + variance[2]) / 3;
            largest = std::max(largest, mean * *reference.sample_count.pixel(i, j));
        }
    return largest;
}

/// Samples each pixel needs for the target, as the pilot sees it, before any limit.
HostImage needed_samples(const ReferenceState& state) {
    const Reference& reference = state.reference;
    const double floor = radiance_floor(reference, reference.specular);
    HostImage needed(reference.extent, 1);
    for (unsigned y = 0; y < reference.extent.y; ++y)
        for (unsigned x = 0; x < reference.extent.x; ++x) {
            const float* mean = reference.specular.mean.pixel(x, y);
            const double radiance = std::max((double(mean[0]) + mean[1] + mean[2]) / 3, floor);
            const double error = state.settings.target_relative_error * radiance;
            const double variance = neighbourhood_variance(reference, x, y);
            *needed.pixel(x, y) =
                variance > 0 ? float(std::min(variance / (error * error), double(max_sample_limit))) : 0.0f;
        }
    return needed;
}

uint64_t final_samples(double needed, double shrink, uint64_t cap) {
    const double least = std::max(double(batch_count), double(min_final_samples) / shrink);
    return std::min(rounded_samples(std::max(needed / shrink, least)), cap);
}

/// The factor by which all pixels get fewer samples than they need, so that the final pass fits the time that is left.
double shrink_to_time(const ReferenceState& state, const HostImage& needed, Limits limit, const RenderClock& clock) {
    if (limit.seconds == 0) return 1;
    const double seconds_per_ray = clock.seconds() / std::max(state.reference.rays, 1.0);
    const double affordable_rays =
        used_share_of_time * std::max(limit.seconds - clock.seconds(), 0.0) / seconds_per_ray;
    const auto rays = [&](double shrink) {
        double sum = 0;
        for (size_t i = 0; i < needed.values.size(); ++i)
            sum += double(final_samples(needed.values[i], shrink, limit.samples)) * state.rays_per_sample.values[i];
        return sum;
    };
    if (rays(1) <= affordable_rays) return 1;
    double low = 0, high = std::log2(double(max_sample_limit));  // of log2: `high` gives every pixel the least
    for (int step = 0; step < 12; ++step) {
        const double middle = 0.5 * (low + high);
        (rays(std::exp2(middle)) <= affordable_rays ? high : low) = middle;
    }
    return std::exp2(high);
}

void render_adaptive(ReferenceState& state, const PixelTracer& tracer, RenderClock& clock, Limits limit) {
    Reference& reference = state.reference;
    if (reference.passes.empty()) {
        state.is_pilot = true;
        state.rays_per_sample = HostImage(reference.extent, 1);
    }
    if (state.is_pilot) {
        const uint64_t samples =
            std::min(pilot_samples, std::max<uint64_t>(uint64_t(limit.samples * pilot_share), batch_count));
        render_uniform(state, tracer, clock, {samples, limit.seconds * pilot_share});
        const HostImage needed = needed_samples(state);
        const double shrink = shrink_to_time(state, needed, limit, clock);
        clear_samples(state, reference.extent);
        state.is_pilot = false;
        state.sample_goal = HostImage(reference.extent, 1);
        for (size_t i = 0; i < needed.values.size(); ++i)
            state.sample_goal.values[i] = float(final_samples(needed.values[i], shrink, limit.samples));
        reference.passes = "adaptive";
    }
    clock.phase_start = std::chrono::steady_clock::now();
    clock.phase_samples_before = total_samples(reference);
    clock.phase_samples = 0;
    for (const float goal : state.sample_goal.values) clock.phase_samples += goal;
    clock.time_limit = 0;  // the goals already fit it
    render_pass(state, tracer, clock);
    state.sample_goal = {};
}

}  // namespace

uint64_t rounded_samples(double samples) {
    const double batches = std::ceil(std::clamp(samples, 1.0, double(max_sample_limit)) / batch_count);
    return batch_count * std::bit_ceil(uint64_t(batches));
}

uint64_t sample_limit(const ReferenceSettings& settings) {
    if (settings.max_samples > 0) return rounded_samples(settings.max_samples);
    const bool ends_otherwise = settings.max_seconds > 0 || settings.target_relative_error > 0;
    return ends_otherwise ? max_sample_limit : uint64_t(ReferenceSettings::default_samples);
}

void render_until_limits(ReferenceState& state, const PixelTracer& tracer, RenderClock& clock) {
    Reference& reference = state.reference;
    const Limits limit = limits(state.settings);
    const float target = state.settings.target_relative_error;
    if (target > 0)
        render_adaptive(state, tracer, clock, limit);
    else
        render_uniform(state, tracer, clock, limit);
    reference.reached_share = target > 0 ? reached_share(reference, target) : 1.0f;
    reference.seconds = clock.seconds();
}
