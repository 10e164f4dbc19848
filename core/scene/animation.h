#pragma once
#include "core/scene/scene.h"

/// The value of a channel at a time (s): glTF 2.0, appendix C. The first and the last key hold beyond them.
glm::vec4 sample_channel(const AnimationChannel& channel, float time);

/// Frames from time 0 to the last key of all channels, 1 without animation.
unsigned animation_frames(const Scene& scene);
