// The interface between techniques and tracers. A technique writes `#include "tracer"` and calls trace(); the pass
// decides the tracer (variants/tracers/tracers.h). All global names of a tracer begin with the tracer's name.
#ifndef TRACERS_TRACE_GLSL
#define TRACERS_TRACE_GLSL
#include "common/image_space.glsl"
#include "common/mirror_ray.glsl"
#include "tracers/outcome.h"

struct TraceRay {
    ivec2 pixel;            // that it starts from
    uint number;            // among the rays of that pixel
    vec3 origin;            // of the pixel's surface: view space (m)
    vec3 direction;         // view space, unit
    vec3 geometric_normal;  // of that surface: view space, unit
    float random;           // [0, 1)
    bool is_mirror;         // nothing blurs what it meets: `hierarchy` takes more care of it
};

struct TraceEnd {
    ivec2 pixel;       // whose surface it met; of hits
    vec2 position;     // where it ended on the un-jittered screen (pixels)
    float distance;    // along the ray (m), of misses too
    float confidence;  // of a hit, in (0, 1]; 0 for misses
    uint outcome;      // outcome.h
};

// The end of a ray without a hit.
TraceEnd missed(uint outcome, vec2 position, float distance) {
    return TraceEnd(ivec2(0), position, distance, 0.0, outcome);
}

uint depth_fetches = 0u;
// Counts a fetch of depth, where the including pass enables it.
void count_fetch() {
#ifdef COUNT_DEPTH_FETCHES
    ++depth_fetches;
#endif
}

// Device depth of a pixel. Tracers read depth through this function, so that fetches are counted.
float fetch_depth(ivec2 pixel) {
    count_fetch();
    return texelFetch(depth, pixel, 0).r;
}

// Length of a ray (m), for parameters of which 0 stands for more than any scene within the far plane has.
float reach_of(float max_distance) { return max_distance > 0.0 ? max_distance : 2.0 * camera.depth.y; }

// Depth behind the visible surface that counts as solid (m). `scene_z`: that surface's, in view space.
float solid_depth(float scene_z, float thickness, float relative_thickness) {
    return thickness + relative_thickness * -scene_z;
}

// Whether a device depth counts as nothing drawn. `sky_depth`: distance from the far plane's up to which it does.
bool is_sky(float device_depth, float sky_depth) { return abs(device_depth - camera.depth.z) <= sky_depth; }

// Whether a ray meets the side of a pixel's surface that the camera does not see.
bool comes_from_behind(vec3 direction, ivec2 pixel) { return !(dot(direction, view_geometric_normal(pixel)) < 0.0); }

// Position on the un-jittered screen (pixels) of uv in the images.
vec2 screen_from_image(vec2 uv) { return uv * camera.extent.xy + camera.jitter.xy; }
#endif
