#pragma once
#include "core/scene/camera.h"

#include <string>

/// By how much (m) neighbouring codes of a depth buffer differ at a depth (m) between the planes of the camera.
double depth_step(const CameraData& camera, DepthFormat format, double depth);

/// A warning if a depth buffer's steps at the farthest surface exceed a hundredth of its distance, else "". `whose`:
/// "camera 'main'". `farthest`: depth (m) of that surface. `remedy`: a sentence, without its stop, that says how to
/// give other planes.
std::string precision_warning(const std::string& whose, const CameraData& camera, DepthFormat format, double farthest,
                              const std::string& remedy);

/// "near 0.1 m, far 100 m".
std::string shown_planes(float near, float far);
