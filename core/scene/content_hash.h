#pragma once
#include "core/scene/scene.h"

/// Hash of all that the scene's light depends on, decoded: geometry, materials, textures, nodes, animation, lights and
/// environment. Not of cameras, names or warnings: the same light under another name is found in the reference cache.
std::string content_hash(const Scene& scene);
