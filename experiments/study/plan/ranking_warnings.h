#pragma once
#include "experiments/study/config/config.h"
#include "experiments/study/plan/study_plan.h"

/// Sentences about what the study's primary error will most likely not rank, and what to change, for `plan` and for the
/// start of `run`. None for a study that measures no error.
///
/// - A point that depends on its seed and has only one is ranked in no shot. In least_scenes or more scenes the scenes
///   are the sample, and one seed is enough.
/// - A mask holds at most the pixels of its shot's frames, and least_noise_samples are needed.
/// - In rooms and streets (scene_family.h) few paths find the lamps that floors reflect, so means of squares have wide
///   intervals. In `rooms_power` `mse` with 64 samples detects a difference of 9 %, flip 1.2 % (metrics/README.md).
///   Below samples_of_rooms samples there is a warning.
std::vector<std::string> ranking_warnings(const Config& config, const StudyPlan& plan);

inline constexpr unsigned samples_of_rooms = 1024;
