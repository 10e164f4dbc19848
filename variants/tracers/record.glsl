// Keeps a tracer's input and result, for core/ray_probe.h. The include that a pass decides (tracers.cpp) defines
// `recorded_rays_per_pixel` before this file.
#ifndef TRACERS_RECORD_GLSL
#define TRACERS_RECORD_GLSL
#include "tracers/trace.glsl"

struct RayRecord {
    vec3 origin;
    float is_traced;
    vec3 direction;
    float confidence;
    vec2 position;
    float distance;
    uint outcome;
    uvec2 pixel;
    uint fetches, unused;
};

layout(std430) buffer ray_records { RayRecord record_of_ray[]; };

uint record_index(TraceRay ray) {
    uint pixel = uint(ray.pixel.y * int(camera.extent.x) + ray.pixel.x);
    return pixel * recorded_rays_per_pixel + ray.number;
}

#ifdef REPLAYED_RAYS
layout(std430) readonly buffer replayed_rays { RayRecord replayed_ray[]; };

// The ray as it was recorded, for RayProbe::replayed. False where there was none.
bool replay(inout TraceRay ray) {
    uint index = record_index(ray);
    ray.origin = replayed_ray[index].origin;
    ray.direction = replayed_ray[index].direction;
    return replayed_ray[index].is_traced > 0.0;
}
#endif

void record(TraceRay ray, TraceEnd end) {
    record_of_ray[record_index(ray)] = RayRecord(ray.origin, 1.0, ray.direction, end.confidence, end.position,
                                                 end.distance, end.outcome, uvec2(end.pixel), depth_fetches, 0u);
}
#endif
