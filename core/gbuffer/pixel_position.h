#pragma once
#include "core/gbuffer/gbuffer_file.h"

/// Where the samples of a G-buffer's pixels lie; `pixel` counts row by row. Computed in double precision, as float32 is
/// too coarse for deep depth ranges.
bool is_background(const HostGBuffer& gbuffer, size_t pixel);
glm::dvec2 sample_uv(const HostGBuffer& gbuffer, size_t pixel);  ///< 0..1 over the image, y down, with its jitter
glm::dvec3 surface_position(const HostGBuffer& gbuffer,
                            size_t pixel);  ///< world space; background lies on the far plane
glm::dvec3 position_at(const HostGBuffer& gbuffer, size_t pixel, float depth);  ///< the same with another device depth
glm::dvec3 view_direction(const HostGBuffer& gbuffer, size_t pixel);  ///< unit, world space, away from the camera
