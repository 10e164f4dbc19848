#include "groundtruth/reference/reference_stopping.h"

#include "groundtruth/reference/reference_error.h"
#include "groundtruth/reference/sample_allocation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace {

constexpr uint64_t first_timed_pass = 16;  ///< short, since nothing is known yet of the speed
constexpr double largest_growth = 4;       ///< of a timed pass over what is held: a speed misjudged before is corrected
/// Of the level at each pass with goals: what was misjudged is corrected at the next, but every pass has a scramble of
/// its own, and the longer the last one is the less is lost against one scramble of all samples.
constexpr double level_growth = 8;
constexpr double used_share_of_time =
    0.97;  ///< of what is left, for a pass that is to be the last: its cost is estimated
/// With a target all pixels first get this many, or what a quarter of the time affords: the other outputs need some,
/// and so do the estimates of what pixels need.
constexpr uint64_t uniform_samples = 256;
constexpr double uniform_share_of_time = 0.25;
constexpr double least_growth = 1.0 / 16;  ///< of a pixel's samples: less would change little

constexpr double least_pass = 1.0 / 64;  ///< of all samples: where needs come to less, time is left to spend
constexpr double factor_step = 1.5;      ///< between factors of needs that are tried then

struct Limits {
    uint64_t samples;  ///< per pixel
    double seconds;    ///< 0: unlimited
};

/// Samples per pixel of the next pass over the whole image where all pixels hold `held`, or 0 if it is done.
uint64_t next_uniform_pass(uint64_t held, Limits limit, double seconds) {
    if (held >= limit.samples) return 0;
    if (limit.seconds == 0)
        return held == 0 ? std::min(first_untimed_pass, limit.samples) : std::min(held, limit.samples - held);
    if (held == 0) return std::min(first_timed_pass, limit.samples);
    const double affordable = (limit.seconds - seconds) * double(held) / seconds;
    const double most = std::min({affordable, largest_growth * double(held), double(limit.samples - held)});
    if (most < batch_count || most < double(held) / 32) return 0;
    return batch_count * std::bit_floor(uint64_t(most) / batch_count);
}

/// Of the passes over the whole image.
Limits uniform_limit(const ReferenceSettings& settings) {
    const uint64_t samples = sample_limit(settings);
    if (settings.target_relative_error == 0) return {samples, settings.max_seconds};
    return {std::min(uniform_samples, samples), settings.max_seconds * uniform_share_of_time};
}

/// Samples of all pixels at the end of a render without a target.
double expected_samples(const ReferenceState& state) {
    return double(uniform_limit(state.settings).samples) * double(state.reference.sample_count.pixel_count());
}

/// False if nothing is left to do.
bool plan_uniform_pass(ReferenceState& state, RenderClock& clock, Limits limit) {
    Reference& reference = state.reference;
    const uint64_t samples = next_uniform_pass(state.level, limit, clock.seconds());
    if (samples == 0) return false;
    state.level += samples;
    state.sample_goal = HostImage(reference.extent, 1, float(state.level));
    reference.passes += (reference.passes.empty() ? "" : "+") + std::to_string(samples);
    clock.all_samples = expected_samples(state);
    clock.time_limit = limit.seconds;
    clock.cuts_pass = false;
    return true;
}

/// Whole batches of a length whose binary form has at most three leading digits: Sobol' points fill the square evenly
/// in powers of two, and nearly so in sums of few. Rounded down.
uint64_t short_binary(double samples) {
    const uint64_t length = uint64_t(std::max(samples, 0.0)) / batch_count;
    const int low_bits = std::max(int(std::bit_width(length)) - 3, 0);
    return batch_count * (length >> low_bits << low_bits);
}

/// What a pixel gets in a pass up to `level`: what it needs, or as much of it as the level allows; 0 where that is
/// little.
uint64_t pass_samples(double held, double needed, double level) {
    const uint64_t least = std::max(uint64_t(least_growth * held), uint64_t(batch_count));
    const double wanted = needed - held;
    if (wanted < double(least)) return 0;
    const uint64_t samples = short_binary(std::min(wanted, level - held));
    return samples < least ? 0 : samples;
}

double estimated_seconds(const ReferenceState& state, const HostImage& needed, double level, double seconds_per_ray) {
    double rays = 0;
    for (size_t i = 0; i < needed.values.size(); ++i)
        rays += double(pass_samples(state.reference.sample_count.values[i], needed.values[i], level)) *
                state.rays_per_sample.values[i];
    return rays * seconds_per_ray;
}

/// The highest level that the next pass can reach in the time that is left.
double affordable_level(const ReferenceState& state, const HostImage& needed, double seconds_per_ray,
                        double seconds_left) {
    const auto fits = [&](double level) {
        return estimated_seconds(state, needed, level, seconds_per_ray) <= used_share_of_time * seconds_left;
    };
    double high = level_growth * double(state.level), low = 0;
    if (fits(high)) return high;
    for (int step = 0; step < 16; ++step) {
        const double middle = 0.5 * (low + high);
        (fits(middle) ? low : high) = middle;
    }
    return low;
}

/// Raises needs by one factor, as far as a pixel's largest allows, until a pass is worth while. Where no noise is known
/// the first samples count as what is needed.
void spend_time_left(const ReferenceState& state, HostImage& needed, Limits limit) {
    const std::vector<float>& held = state.reference.sample_count.values;
    const double worth_while = least_pass * total_samples(state.reference);
    const auto is_little = [&] {
        double added = 0;
        for (size_t i = 0; i < held.size(); ++i)
            added += double(pass_samples(held[i], needed.values[i], double(limit.samples)));
        return added < worth_while;
    };
    if (!is_little()) return;
    const HostImage base = needed, largest = largest_factors(state);
    for (double factor = factor_step; factor < double(limit.samples) && is_little(); factor *= factor_step)
        for (size_t i = 0; i < held.size(); ++i) {
            if (largest.values[i] == 1.0f) continue;
            const double least = std::max(double(base.values[i]), double(uniform_samples));
            const double raised = least * std::min(factor, double(largest.values[i]));
            needed.values[i] = float(std::min(raised, double(limit.samples)));
        }
}

/// The next pass of a render with a target: pixels below the level that need more go up to it, or to what they need. So
/// where time ends first, those that need most have had as many samples as a uniform render would have given them.
bool plan_target_pass(ReferenceState& state, RenderClock& clock, Limits limit) {
    Reference& reference = state.reference;
    HostImage needed = needed_samples(state);
    if (limit.seconds > 0) spend_time_left(state, needed, limit);
    double level = std::min(level_growth * double(state.level), double(limit.samples));
    if (limit.seconds > 0)
        level = std::min(
            level, affordable_level(state, needed, clock.seconds_per_ray(reference), limit.seconds - clock.seconds()));

    HostImage goal(reference.extent, 1), earlier(reference.extent, 2);
    bool is_done = true;
    clock.all_samples = 0;
    for (size_t i = 0; i < goal.values.size(); ++i) {
        const double held = reference.sample_count.values[i];
        const uint64_t samples = pass_samples(held, needed.values[i], level);
        goal.values[i] = float(held + double(samples));
        clock.all_samples += std::max(held, double(needed.values[i]));
        if (samples == 0) {  // the last pass's estimate stays
            for (size_t c = 0; c < 2 && !state.earlier.values.empty(); ++c)
                earlier.values[2 * i + c] = state.earlier.values[2 * i + c];
            continue;
        }
        is_done = false;
        const glm::vec3 variance = reference.specular.variance.rgb(i);
        earlier.values[2 * i] = float(held);
        earlier.values[2 * i + 1] = (variance.x + variance.y + variance.z) / 3;
    }
    if (is_done) return false;
    state.level = std::max(uint64_t(level), state.level);
    state.sample_goal = std::move(goal);
    state.earlier = std::move(earlier);
    reference.passes += ", to " + std::to_string(state.level);
    clock.time_limit = limit.seconds;
    clock.cuts_pass = true;
    return true;
}

/// For a pass that was stopped midway: its plan's estimates for the clock, as far as the state has them.
void resume_plan(const ReferenceState& state, RenderClock& clock) {
    const Limits uniform = uniform_limit(state.settings);
    const bool has_target = !state.earlier.values.empty();
    clock.cuts_pass = has_target;
    clock.time_limit = has_target ? state.settings.max_seconds : uniform.seconds;
    clock.all_samples = has_target
                            ? std::accumulate(state.sample_goal.values.begin(), state.sample_goal.values.end(), 0.0)
                            : expected_samples(state);
}

bool plan_pass(ReferenceState& state, RenderClock& clock) {
    const Limits limit{sample_limit(state.settings), state.settings.max_seconds},
        uniform = uniform_limit(state.settings);
    if (state.settings.target_relative_error == 0) return plan_uniform_pass(state, clock, uniform);
    if (limit.seconds > 0 && state.rays_per_sample.values.empty()) {
        const double samples = std::max(total_samples(state.reference), 1.0);
        state.rays_per_sample = HostImage(state.reference.extent, 1, float(state.reference.rays / samples));
    }
    return (state.earlier.values.empty() && plan_uniform_pass(state, clock, uniform)) ||
           plan_target_pass(state, clock, limit);
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

uint64_t lit_sample_limit(const ReferenceSettings& settings) {
    return settings.lit_samples > 0 ? rounded_samples(settings.lit_samples) : 0;
}

bool can_be_extended(const ReferenceSettings& finished, const ReferenceSettings& wanted) {
    const uint64_t held = sample_limit(finished), limit = sample_limit(wanted);
    if ((finished.max_seconds > 0) != (wanted.max_seconds > 0) || held > limit) return false;
    const float its_target = finished.target_relative_error, target = wanted.target_relative_error;
    if (wanted.max_seconds == 0) return its_target == 0 && target == 0 && (held == limit || held >= first_untimed_pass);
    return finished.max_seconds <= wanted.max_seconds && (its_target == 0 || (target > 0 && target <= its_target));
}

void render_until_limits(ReferenceState& state, const PixelTracer& tracer, RenderClock& clock) {
    Reference& reference = state.reference;
    const float target = state.settings.target_relative_error;
    if (!state.sample_goal.values.empty()) {
        resume_plan(state, clock);
        render_pass(state, tracer, clock);
    }
    while (plan_pass(state, clock)) render_pass(state, tracer, clock);
    state.sample_goal = {};
    reference.reached_share = target > 0 ? reached_share(reference, target) : 1.0f;
    reference.seconds = clock.seconds();
}
