#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/plan/study_plan.h"

/// What will most likely not be ranked by the study's primary error, and what to change: sentences, for `plan` and for
/// the start of `run`. Of a study that measures no error there are none.
///
/// - A point that depends on its seed, and has one, is ranked in no shot; over least_scenes or more its scenes are the
///   sample, and one seed will do.
/// - No mask of a shot holds more pixels than its frames, and least_noise_samples of them are needed.
/// - Rooms and streets (scene_family.h): few paths find the lamps that floors reflect, so that means of squares have
///   wide intervals. In `rooms_power` `mse` of 64 samples sees a difference of 9 % where flip sees 1.2 %
///   (metrics/README.md): below samples_of_rooms the study is warned.
std::vector<std::string> ranking_warnings(const Config& config, const StudyPlan& plan);

inline constexpr unsigned samples_of_rooms = 1024;
