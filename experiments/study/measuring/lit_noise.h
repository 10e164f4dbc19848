#pragma once
#include "experiments/results/cells/reference_noise.h"
#include "experiments/study/measuring/measure.h"

#include <map>
#include <string>

/// Whether the halves' light differs by more than 1e-5 of itself anywhere: less is the rounding of means.
bool is_noisy(const ReferenceHalves& light);

/// LitNoise of a technique's errors, by their names; nullopt: the light of both halves is the same, as where all of it
/// is emission, and nothing is added to any error. Techniques read the path-traced lit colour of the reference that
/// they are compared with. All seeds read the same, so its noise is a bias of all of them, which neither the correction
/// for the reference's noise nor the scatter of the seeds includes. A reflection probe is no part of it: its noise does
/// not depend on the reference (reflection_probe.h).
///
/// It is estimated from two further runs of the point, with one seed, that read the lit colour of half A and of half B.
/// To first order a result is linear in what it reads, so that with x_a, x_b those two results
///     E[w (x_a - x_b)^2 / 4] = E[w (x - x without that noise)^2]
/// is what the noise of the mean lit colour adds to a mean of weighted squares: pixels draw independent samples, so
/// that what x reads elsewhere is independent of the halves that it is compared with. Where the number of rays or the
/// filter of a technique depends on the light that it read, x_a and x_b also differ by that.
///
/// Measured with ten references of 16 samples at 48x27 against light of 512 samples (in brackets): mcguire_dda in
/// modern_hall_mirror_floor adds 0.0175 (0.0175 +- 0.0019) to a relmse of 0.165, in breakfast_room_glossy_floor 0.0036
/// (0.0040 +- 0.0019) to an mse of 0.130; frostbite_sssr 0.0155 (0.0149 +- 0.0026) to a relmse of 0.433, and 0.0006
/// (0.0018 +- 0.0004) to an mse of 0.120. Scenes whose lit colour is emission alone have none.
using LitNoiseOfErrors = std::optional<std::map<ErrorName, LitNoise>>;
inline const LitNoiseOfErrors unknown_lit_noise = std::map<ErrorName, LitNoise>();

/// Adds one frame of both results, composited and compared as measure_targets() (the full measure of the shot's last
/// frame) and measure_frame() do.
void add_lit_noise_of_targets(LitNoiseOfErrors& noise, const PoseTruth& truth, const CompositedImages& of_a,
                              const CompositedImages& of_b, std::span<const Mask> masks, const std::string& frame);
void add_lit_noise_of_frame(LitNoiseOfErrors& noise, const PoseTruth& truth, const CompositedImages& of_a,
                            const CompositedImages& of_b, std::span<const Mask> masks, const std::string& frame);

/// What it adds to one number; nothing where that is not known.
std::optional<LitNoise> lit_noise_of(const LitNoiseOfErrors& noise, const ErrorName& error);

/// Writes lit_noise and lit_half_width into the rows of whose error they are known.
void set_lit_noise(std::span<ResultRow> rows, const LitNoiseOfErrors& noise);
