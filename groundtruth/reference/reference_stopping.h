#pragma once
#include "groundtruth/reference/reference_passes.h"

inline constexpr uint64_t max_sample_limit = 1 << 24;  ///< float32 counts exactly so far
inline constexpr uint64_t first_untimed_pass = 256;    ///< samples; passes double from here, see ReferenceSettings

/// The least 16 * 2^k that is not below `samples`, at most max_sample_limit.
uint64_t rounded_samples(double samples);

/// Samples per pixel at which a render of these settings ends: the set number, else the default if nothing else ends
/// it.
uint64_t sample_limit(const ReferenceSettings& settings);

/// Samples per pixel at which the diffuse light ends; 0: with the render.
uint64_t lit_sample_limit(const ReferenceSettings& settings);

/// Whether a render may continue a finished one of the same samples. With a time limit it may, if the finished one had
/// no larger limits of time, samples or precision. Counts then depend on the clock, so no bits are promised; but no
/// pixel's count depends on its own samples, so the result is sound. Without a time limit the request decides the bits.
/// Only uniform renders grow then, in whole doublings, as a new render would. A render with a target would visit its
/// pixels in other passes, and starts anew.
bool can_be_extended(const ReferenceSettings& finished, const ReferenceSettings& wanted);

/// Continues `state` (empty, within a pass, or to be added to) until the limits of state.settings. Saves, reports and
/// throws as render_pass() does.
void render_until_limits(ReferenceState& state, const PixelTracer& tracer, RenderClock& clock);
