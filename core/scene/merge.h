#pragma once
#include "core/scene/scene.h"

/// Appends all that `other` draws, lights and animates to `scene`, with its cameras and warnings.
void merge(Scene& scene, Scene other);
