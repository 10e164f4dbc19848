#pragma once
#include "core/json.h"
#include "core/scene/scene.h"

#include <map>
#include <utility>

/// A required colour. Fails with Error unless each part is in [0, max].
glm::vec3 read_color(JsonObject& entry, const std::string& key, float max);

/// Texels that overrides made, by their source and the channel that was set to 1. The overrides of a scene share them.
using ChangedTexels = std::map<std::pair<Texels, size_t>, Texels>;

/// One entry of scene.json's `overrides`: changes all materials whose whole name matches the regular expression
/// `material` (RE2's syntax). A given roughness, metalness, base colour or emission takes the place of the texture
/// channel. `hidden` removes what has the material. Fails if no material matches.
void apply_override(JsonObject& entry, Scene& scene, ChangedTexels& changed);
