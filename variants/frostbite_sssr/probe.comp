// One probe ray per block of 8x8 pixels: what it sees, and whether it is on the screen.
#include "tracer"
#include "rough_tracer"
#include "common/luminance.glsl"
#include "frostbite_sssr/reuse.glsl"
#include "frostbite_sssr/tile.glsl"
#include "frostbite_sssr/trace_ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D hit_color, fallback;
uniform writeonly image2D probes;

TraceEnd march(TraceRay ray) {
    return texelFetch(normal, ray.pixel, 0).w >= rough_from ? rough_trace(ray) : smooth_trace(ray);
}

// Number `turn` of a block's 64 pixels, the next ones as far apart as can be: each pair of bits halves the distance.
ivec2 pixel_of_turn(uint turn) {
    ivec2 pixel = ivec2(0);
    for (uint level = 0u; level < 3u; ++level)
        pixel = 2 * pixel + quad_pixel(turn >> 2u * level);
    return pixel;
}

// The block's pixel of this frame, or the next one that starts rays, so that a thin reflector is probed as often as a
// wide one; negative if none does. Of eight blocks in a row or column no two look at the same row or column of theirs:
// a line one pixel wide that runs through all of them is met in every frame.
ivec2 probed_pixel(ivec2 block) {
    for (uint i = 0u; i < 64u; ++i) {
        ivec2 inside = pixel_of_turn(camera.frame.x + first_turn(camera.frame.y) + i) + 3 * block.yx & block_width - 1;
        ivec2 pixel = block * block_width + inside;
        if (is_on_screen(pixel) && starts_rays(pixel)) return pixel;
    }
    return ivec2(-1);
}

vec3 color_at(ivec2 pixel) { return textureLod(hit_color, color_uv_of(pixel), 0.0).rgb; }

float compressed_luminance(vec3 color) {
    float luminance = max(luminance_bt709(color), 0.0);
    return luminance / (1.0 + luminance);
}

vec2 probe(ivec2 block) {
    ivec2 pixel = probed_pixel(block);
    if (pixel.x < 0) return vec2(0.0, no_probe);
    TracedRay ray = trace_ray(pixel, 0u, probe_dimension);
    if (ray.target == ray_into_surface) return vec2(0.0, probe_missed);
    if (is_hit(ray)) return vec2(compressed_luminance(color_at(pixel_of_target(ray.target))), probe_hit);
    return vec2(compressed_luminance(texelFetch(fallback, pixel, 0).rgb), probe_missed);
}

void main() {
    ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(block, imageSize(probes)))) return;
    imageStore(probes, block, vec4(probe(block), 0.0, 0.0));
}
