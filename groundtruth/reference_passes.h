#pragma once
#include "groundtruth/reference_file.h"
#include "groundtruth/reference_pixel.h"

#include <chrono>

/// An empty state of `extent` for its settings: no samples, no goal. Settings, stream and hash stay, and what was
/// spent.
void clear_samples(ReferenceState& state, glm::uvec2 extent);

/// What a running render does by the clock: it reports, and it saves its state.
struct RenderClock {
    using Instant = std::chrono::steady_clock::time_point;

    const ReferenceRun& run;
    double seconds_before = 0, rays_before = 0;  ///< of earlier runs
    double time_limit = 0;                       ///< over all runs (s); 0: none
    double phase_samples = 0;                    ///< of all pixels, at the end of the phase, if the time suffices
    double phase_samples_before = 0;             ///< that earlier runs made
    Instant start = std::chrono::steady_clock::now(), phase_start = start, last_save = start, last_report = start;
    double save_seconds = 0;  ///< how long the last save took

    double seconds() const;  ///< of this and the earlier runs
};

/// Samples of all pixels.
double total_samples(const Reference& reference);

/// Brings every pixel from its sample_count to its sample_goal in 16 batches of equal size, with all threads of the
/// caller's arena. The goals are reached when it returns, unless a report throws: then the state is saved and the
/// exception goes on.
void render_pass(ReferenceState& state, const PixelTracer& tracer, RenderClock& clock);
