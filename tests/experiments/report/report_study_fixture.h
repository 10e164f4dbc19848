#pragma once
#include <filesystem>
#include <string>

/// A made-up results folder of a study with baselines, without images: five shots at rest, one that moves and one with
/// a change; `none`, presets `first` (the baseline, timed) and `fixed`, and two changes of `first` by one parameter,
/// one of which changes nothing. It has classes of roughness, frames, temporal metrics (one without a value, which a
/// note explains), bias and variance (one bias below 0), verdicts of rays, and effects as paired_effects() finds them.
void write_study_fixture(const std::filesystem::path& folder);

inline const std::string study_step_shot = "step.main.160x90.f29-44.w8",
                         study_moving_shot = "moving.main.160x90.f3-6.w4";
