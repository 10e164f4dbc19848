#pragma once
#include "experiments/study/shots/point_renders.h"

/// Makes the cell of a point whose frames another program rendered (PointConfig::external). Reads the frames, refuses
/// them if they do not show the shot's scene, and measures them like a technique's. Their specular light is the image
/// minus the truth's light without reflections. Fails with Error where a frame is missing or cannot be compared; the
/// results folder then holds a picture of the differences.
Cell measure_external(const Shot& shot, const ShotTruth& truth, const Config& config, const PointConfig& technique,
                      const PointSettings& settings);
