#pragma once
#include "core/json.h"
#include "core/scene/scene.h"

/// One entry of scene.json's `cameras`; its keys are in scenes/README.md. `scene` holds the glTF's cameras, and the
/// geometry from which near and far are derived where the entry gives none.
SceneCamera read_camera(JsonObject entry, const Scene& scene);

/// A vector of the file as a unit vector. Fails with Error if it is zero.
glm::vec3 read_direction(JsonObject& object, const std::string& key);

/// A required point within any_length of the origin, along each axis (m).
glm::vec3 read_position(JsonObject& object, const std::string& key);
