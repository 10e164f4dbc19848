#pragma once
#include "experiments/study/config/shots/shot.h"

/// What a user should know of the planes of a shot's camera, from its first frame and before anything is rendered: in
/// how many pixels they cut surfaces, and where they leave too little precision in the depth format that the shot has.
std::vector<SceneWarning> plane_warnings(const Shot& shot);
