#pragma once
#include "core/scene/scene.h"

/// What a punctual light sends to a point, before visibility is known.
struct PunctualArrival {
    glm::vec3 direction;   ///< unit, towards the light; not a number if the point is the light's own
    glm::vec3 irradiance;  ///< at normal incidence (W m^-2)
    bool is_infinite;      ///< the light has no place
};
/// `point`: m, world space. Range and cone follow KHR_lights_punctual.
PunctualArrival arrival(const PunctualLight& light, glm::vec3 point);
