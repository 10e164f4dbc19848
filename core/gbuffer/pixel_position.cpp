#include "core/gbuffer/pixel_position.h"

bool is_background(const HostGBuffer& g, size_t pixel) { return g.depth.values[pixel] == g.camera.depth.z; }

glm::dvec2 sample_uv(const HostGBuffer& g, size_t pixel) {
    const glm::dvec2 corner(double(pixel % g.extent().x), double(pixel / g.extent().x));
    return (corner + 0.5 + glm::dvec2(g.camera.jitter.x, g.camera.jitter.y)) / glm::dvec2(g.extent());
}

glm::dvec3 position_at(const HostGBuffer& g, size_t pixel, float depth) {
    const glm::dvec4 clip(sample_uv(g, pixel) * 2.0 - 1.0, double(depth), 1.0);
    const glm::dvec4 world = glm::dmat4(g.camera.world_from_clip) * clip;
    return glm::dvec3(world) / world.w;
}

glm::dvec3 surface_position(const HostGBuffer& g, size_t pixel) { return position_at(g, pixel, g.depth.values[pixel]); }

glm::dvec3 view_direction(const HostGBuffer& g, size_t pixel) {
    if (g.camera.frame.z == 1) return -glm::normalize(glm::dvec3(g.camera.world_from_view[2]));
    return glm::normalize(surface_position(g, pixel) - glm::dvec3(g.camera.world_from_view[3]));
}
