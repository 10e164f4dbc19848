#pragma once
#include "experiments/results/cells/reference_noise.h"
#include "experiments/study/measuring/measure.h"

#include <map>
#include <string>

/// Whether the light of both halves differs anywhere by more than 1e-5 of its value: less is rounding of means.
bool is_noisy(const ReferenceHalves& light);

/// LitNoise of a technique's errors by name. nullopt: the light of both halves is equal, and no error gets noise from
/// it; an example is light that is all emission. Techniques read the path-traced lit colour of the reference that they
/// are compared with. All seeds read the same image, so its noise is a bias of all of them. Neither the correction for
/// the reference's noise nor the scatter of seeds includes it. The noise of a reflection probe is not part of it, as it
/// does not depend on the reference (reflection_probe.h).
///
/// The estimate needs two further runs of the point with one seed, which read the lit colour of half A and of half B.
/// To first order a result is linear in the light that it reads. With x_a, x_b these two results,
///     E[w (x_a - x_b)^2 / 4] = E[w (x - x without that noise)^2]
/// is what the noise of the mean lit colour adds to a mean of weighted squares. Pixels draw independent samples, so
/// light that x reads elsewhere is independent of the halves that it is compared with. If a technique's number of rays
/// or filter depends on the light that it read, x_a and x_b differ by that as well.
///
/// Measured with ten references of 16 samples at 48x27, against light of 512 samples (in brackets):
///
/// - mcguire_dda, modern_hall_mirror_floor: 0.0175 (0.0175 +- 0.0019) of a relmse of 0.165
/// - mcguire_dda, breakfast_room_glossy_floor: 0.0036 (0.0040 +- 0.0019) of an mse of 0.130
/// - frostbite_sssr: 0.0155 (0.0149 +- 0.0026) of a relmse of 0.433
/// - frostbite_sssr: 0.0006 (0.0018 +- 0.0004) of an mse of 0.120
///
/// Scenes whose lit colour is emission alone have no such noise.
using LitNoiseOfErrors = std::optional<std::map<ErrorName, LitNoise>>;
inline const LitNoiseOfErrors unknown_lit_noise = std::map<ErrorName, LitNoise>();

/// Adds one frame of both results. Both are composited and compared as in measure_targets() (all targets of the shot's
/// last frame), or as in measure_frame().
void add_lit_noise_of_targets(LitNoiseOfErrors& noise, const PoseTruth& truth, const CompositedImages& of_a,
                              const CompositedImages& of_b, std::span<const Mask> masks, const std::string& frame);
void add_lit_noise_of_frame(LitNoiseOfErrors& noise, const PoseTruth& truth, const CompositedImages& of_a,
                            const CompositedImages& of_b, std::span<const Mask> masks, const std::string& frame);

/// The LitNoise of one error; nullopt where it is unknown.
std::optional<LitNoise> lit_noise_of(const LitNoiseOfErrors& noise, const ErrorName& error);

/// Sets lit_noise and lit_half_width of the rows whose error has a known LitNoise.
void set_lit_noise(std::span<ResultRow> rows, const LitNoiseOfErrors& noise);
