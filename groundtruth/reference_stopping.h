#pragma once
#include "groundtruth/reference_passes.h"

inline constexpr uint64_t max_sample_limit = 1 << 24;  ///< float32 counts exactly so far
inline constexpr uint64_t first_untimed_pass = 256;    ///< samples; passes double from here, see ReferenceSettings

/// The least 16 * 2^k that is not below `samples`, at most max_sample_limit.
uint64_t rounded_samples(double samples);

/// Samples per pixel at which a render of these settings ends: what is set; else, if nothing else ends it, the default.
uint64_t sample_limit(const ReferenceSettings& settings);

/// Continues `state` (empty, within a pass, or to be added to) until the limits of state.settings. Saves, reports and
/// throws as render_pass() does.
void render_until_limits(ReferenceState& state, const PixelTracer& tracer, RenderClock& clock);
