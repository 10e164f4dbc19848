#pragma once
#include "core/json.h"
#include "core/scene/scene.h"

/// One entry of scene.json's `overrides`: changes all materials whose whole name matches the regular expression
/// `material`. A given roughness, metalness, base colour or emission takes the place of the texture channel. `hidden`
/// removes what has the material. Fails if no material matches.
void apply_override(JsonObject& entry, Scene& scene);
