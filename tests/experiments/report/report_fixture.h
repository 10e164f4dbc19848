#pragma once
#include "core/host_image.h"

#include <filesystem>
#include <string>

/// A made-up results folder as `ssrlab run` leaves it: three shots, `none` and `mcguire_dda` with two strides, two
/// seeds, two targets, times, and images of a striped wall above a mirror floor. Some of it is there to be warned
/// about: a failed clock proof, a reference that fell short, one NaN pixel.
void write_report_fixture(const std::filesystem::path& folder);

inline const std::string fixture_shots[] = {"mirror_pillars.front.160x90", "fence.low.160x90",
                                            "roughness_gradient.side.161x91"};
