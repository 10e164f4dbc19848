#pragma once
#include "experiments/study/shots/point_renders.h"

/// The cell of a point whose frames another program rendered (PointConfig::external): read, refused where they do not
/// show the shot's scene, and measured as a technique's are. Its specular light is the image less the truth's light
/// without reflections. Fails with Error where a frame is missing or cannot be compared; the picture of where it
/// differs is then in the folder of the results.
Cell measure_external(const Shot& shot, const ShotTruth& truth, const Config& config, const PointConfig& technique,
                      const PointSettings& settings);
