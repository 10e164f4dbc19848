#pragma once
#include "core/scene/scene.h"

/// Hash of all that the scene's light depends on, decoded: geometry, materials, textures, nodes, animation, lights and
/// environment. Cameras, names and warnings do not count: the reference cache finds the same light under another name.
std::string content_hash(const Scene& scene);
