// The classification, with the same output as classify.comp. A thread classifies a tile: on a CPU, barriers and shared
// memory cost more than the pixels. Rays are listed tile by tile. Quads are not unrolled: that would take a second more
// to compile.
#extension GL_EXT_control_flow_attributes : require
#include "amd_sssr/classification.glsl"

layout(local_size_x = 8) in;

uint place = 0u, states = 0u;  // of a pixel in its quad; of that quad's pixels, two bits each
uint place_in_quad() { return place; }
bool neighbour_is(uint flip, uint state) { return (states >> 2u * (place ^ flip) & state) != 0u; }

uint quad_states(ivec2 start) {
    uint of_quad = 0u;
    for (uint i = 0u; i < 4u; ++i) {
        ivec2 position = start + ivec2(i & 1u, i >> 1u);
        Pixel pixel = classify(position);
        of_quad |= state_of(pixel, position) << 2u * i;
        store_classified(pixel, position);
    }
    return of_quad;
}

// Bit i: pixel i traces.
uint tracing_pixels() {
    uint tracing = 0u;
    for (place = 0u; place < 4u; ++place) {
        uint state = states >> 2u * place & 3u;
        if (state == is_tracing || (trace_orphans && is_orphan(state))) tracing |= 1u << place;
    }
    return tracing;
}

void main() {
    ivec2 start = ivec2(gl_GlobalInvocationID.xy) * 8;
    if (!is_on_screen(start)) return;
    uint of_quads[16], rays = 0u;
    bool is_glossy_tile = false;
    [[dont_unroll]] for (uint quad = 0u; quad < 16u; ++quad) {
        states = quad_states(start + position_in_tile(4u * quad));
        of_quads[quad] = states;
        is_glossy_tile = is_glossy_tile || states != 0u;
        rays += bitCount(tracing_pixels());
    }
    if (!is_glossy_tile) return;
    list_tile(start);
    uint next = atomicAdd(rays_being_listed, rays);
    [[dont_unroll]] for (uint quad = 0u; quad < 16u; ++quad) {
        states = of_quads[quad];
        for (uint tracing = tracing_pixels(); tracing != 0u; tracing &= tracing - 1u) {
            place = findLSB(tracing);
            ivec2 position = start + position_in_tile(4u * quad + place);
            listed_ray[next++] = pack_ray(position) | copy_flags(position);
        }
    }
}
