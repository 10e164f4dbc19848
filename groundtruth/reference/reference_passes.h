#pragma once
#include "groundtruth/reference/reference_file.h"
#include "groundtruth/reference/reference_pixel.h"

#include <chrono>

/// A state of `extent` without samples or goals.
ReferenceState empty_state(glm::uvec2 extent, const ReferenceSettings& settings);

/// When a running render reports, saves its state and ends.
struct RenderClock {
    using Instant = std::chrono::steady_clock::time_point;

    const ReferenceRun& run;
    double seconds_before = 0, rays_before = 0;  ///< of earlier runs
    double time_limit = 0;                       ///< over all runs (s); 0: none
    /// Ends the pass under way within 105 % of the time limit, even if pixels have not reached their goals: estimates
    /// of a pass's cost fail on machines that do other work. A pixel is traced whole or not at all.
    bool cuts_pass = false;
    double all_samples = 0;  ///< of all pixels, expected at the end of the render
    Instant start = std::chrono::steady_clock::now(), last_save = start, last_report = start;
    double save_seconds = 0;                 ///< how long the last save took
    double pass_seconds = 0, pass_rays = 0;  ///< of the last pass; 0: none yet

    double seconds() const;                                    ///< of this and the earlier runs
    double seconds_per_ray(const Reference& reference) const;  ///< of the last pass, else of the earlier runs
};

/// Samples of all pixels.
double total_samples(const Reference& reference);

/// Brings every pixel from its sample_count to its sample_goal in 16 batches of equal size, with all threads of the
/// caller's arena. Afterwards goals are reached; with RenderClock::cuts_pass they may be lowered to the samples that
/// exist. If a report throws, the state is saved and the exception goes on.
void render_pass(ReferenceState& state, const PixelTracer& tracer, RenderClock& clock);
