#include "groundtruth/lights/punctual_arrival.h"

#include "core/shared/punctual_light.h"

PunctualArrival arrival(const PunctualLight& light, glm::vec3 point) {
    if (light.type == LightType::directional) return {-light.direction, light.intensity, true};
    const glm::vec3 to_light = light.position - point;
    const float distance = glm::length(to_light);
    PunctualArrival arriving{to_light / distance, light.intensity * punctual_falloff(distance, light.range), false};
    if (light.type == LightType::spot)
        arriving.irradiance *= spot_attenuation(-glm::dot(arriving.direction, light.direction), light.inner_cone_cos,
                                                light.outer_cone_cos);
    return arriving;
}
