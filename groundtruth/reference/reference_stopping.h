#pragma once
#include "groundtruth/reference/reference_passes.h"

inline constexpr uint64_t max_sample_limit = 1 << 24;  ///< float32 counts exactly so far
inline constexpr uint64_t first_untimed_pass = 256;    ///< samples; passes double from here, see ReferenceSettings

/// The least 16 * 2^k that is not below `samples`, at most max_sample_limit.
uint64_t rounded_samples(double samples);

/// Samples per pixel at which a render of these settings ends: what is set; else, if nothing else ends it, the default.
uint64_t sample_limit(const ReferenceSettings& settings);

/// Samples per pixel of the diffuse light at which it ends; 0: at those of the render.
uint64_t lit_sample_limit(const ReferenceSettings& settings);

/// Whether a render may begin with what a finished one of the same samples left. With a time limit it may, if the other
/// had no more time, samples or precision to reach: counts depend on the clock there, so no bits are promised, and
/// since no pixel's count depends on its own samples the result is as sound as if it had never stopped. Without a time
/// limit the bits follow from the request: only uniform renders grow, in whole doublings, which are what a render of
/// its own would do; one with a target would visit its pixels in other passes, and is rendered anew.
bool can_be_extended(const ReferenceSettings& finished, const ReferenceSettings& wanted);

/// Continues `state` (empty, within a pass, or to be added to) until the limits of state.settings. Saves, reports and
/// throws as render_pass() does.
void render_until_limits(ReferenceState& state, const PixelTracer& tracer, RenderClock& clock);
