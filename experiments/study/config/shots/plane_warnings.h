#pragma once
#include "experiments/study/config/shots/shot.h"

/// Warnings about the near and far planes of a shot's camera, from its first frame, before anything is rendered. They
/// say in how many pixels the planes cut surfaces, and where the shot's depth format has too little precision.
std::vector<SceneWarning> plane_warnings(const Shot& shot);
