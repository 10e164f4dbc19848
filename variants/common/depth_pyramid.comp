// All levels of a depth pyramid in one dispatch, as AMD's Single Pass Downsampler: a group reduces 64x64 texels to one,
// and the group that finishes last reduces what the others have left.
#include "common/image_space.glsl"

layout(local_size_x = 256) in;
layout(push_constant) uniform Levels { uint level_count, group_count, keeps_farthest; };
uniform sampler2D depth;
uniform writeonly image2D mip_0, mip_1, mip_2, mip_3, mip_4, mip_5, mip_7, mip_8, mip_9, mip_10, mip_11, mip_12;
layout(r32f) uniform coherent image2D mip_6;
buffer depth_pyramid_counter { uint finished_groups; };

shared float tile[32 * 32];
shared bool is_last_group;

bool keeps_larger() { return is_reversed() != (keeps_farthest == 1u); }
float kept_of(float a, float b) { return keeps_larger() ? max(a, b) : min(a, b); }

// Background is no surface: the farthest one is not there.
float device_depth_of(ivec2 pixel) {
    float value = texelFetch(depth, pixel, 0).r;
    float nearest = 1.0 - camera.depth.z;
    return keeps_farthest == 1u && value == camera.depth.z ? nearest : value;
}

ivec2 extent_of(uint level) { return max(ivec2(camera.extent.xy) >> int(level), ivec2(1)); }

void store(uint level, ivec2 texel, float value) {
    if (level >= level_count || any(greaterThanEqual(texel, extent_of(level)))) return;
    switch (level) {
        case 1u: imageStore(mip_1, texel, vec4(value)); break;
        case 2u: imageStore(mip_2, texel, vec4(value)); break;
        case 3u: imageStore(mip_3, texel, vec4(value)); break;
        case 4u: imageStore(mip_4, texel, vec4(value)); break;
        case 5u: imageStore(mip_5, texel, vec4(value)); break;
        case 6u: imageStore(mip_6, texel, vec4(value)); break;
        case 7u: imageStore(mip_7, texel, vec4(value)); break;
        case 8u: imageStore(mip_8, texel, vec4(value)); break;
        case 9u: imageStore(mip_9, texel, vec4(value)); break;
        case 10u: imageStore(mip_10, texel, vec4(value)); break;
        case 11u: imageStore(mip_11, texel, vec4(value)); break;
        case 12u: imageStore(mip_12, texel, vec4(value)); break;
    }
}

// Mip 0 or 6. A level that is one texel wide or high has no second one to reduce; the first counts twice.
float source(uint level, ivec2 texel) {
    texel = min(texel, extent_of(level) - 1);
    return level == 0u ? device_depth_of(texel) : imageLoad(mip_6, texel).r;
}

float kept_of_four(float a, float b, float c, float d) { return kept_of(kept_of(a, b), kept_of(c, d)); }

// Fills `tile` with 32x32 texels of the level above `level`.
void reduce_source(uint level, ivec2 tile_index) {
    for (uint i = gl_LocalInvocationIndex; i < 32u * 32u; i += 256u) {
        ivec2 inside = ivec2(i % 32u, i / 32u), texel = tile_index * 32 + inside, from = 2 * texel;
        float value = kept_of_four(source(level, from), source(level, from + ivec2(1, 0)),
                                      source(level, from + ivec2(0, 1)), source(level, from + ivec2(1, 1)));
        tile[i] = value;
        store(level + 1u, texel, value);
    }
    barrier();
}

// Reduces `tile`, which holds a part of `level`, to `width` x `width` texels of the level above.
void halve_tile(int width, uint level, ivec2 tile_index) {
    ivec2 inside = ivec2(gl_LocalInvocationIndex % 16u, gl_LocalInvocationIndex / 16u);
    ivec2 last = extent_of(level) - 1 - tile_index * 2 * width;  // in the tile
    bool is_active = all(lessThan(inside, ivec2(width)));
    float value = 0.0;
    if (is_active) {
        ivec2 a = 2 * inside, b = max(min(a + 1, last), a);
        value = kept_of_four(tile[a.y * 32 + a.x], tile[a.y * 32 + b.x], tile[b.y * 32 + a.x], tile[b.y * 32 + b.x]);
        store(level + 1u, tile_index * width + inside, value);
    }
    barrier();
    if (is_active) tile[inside.y * 32 + inside.x] = value;
    barrier();
}

// The same to one texel of the fifth level above. No loop: of a level that is a constant, store() is one instruction.
void reduce_tile(uint level, ivec2 tile_index) {
    halve_tile(16, level, tile_index);
    halve_tile(8, level + 1u, tile_index);
    halve_tile(4, level + 2u, tile_index);
    halve_tile(2, level + 3u, tile_index);
    halve_tile(1, level + 4u, tile_index);
}

void copy_first_level(ivec2 tile_index) {
    for (uint i = gl_LocalInvocationIndex; i < 64u * 64u; i += 256u) {
        ivec2 texel = tile_index * 64 + ivec2(i % 64u, i / 64u);
        if (all(lessThan(texel, extent_of(0u)))) imageStore(mip_0, texel, vec4(device_depth_of(texel)));
    }
}

void main() {
    ivec2 tile_index = ivec2(gl_WorkGroupID.xy);
    copy_first_level(tile_index);
    reduce_source(0u, tile_index);
    reduce_tile(1u, tile_index);
    if (level_count <= 7u) return;

    memoryBarrierImage();
    if (gl_LocalInvocationIndex == 0u) {
        is_last_group = atomicAdd(finished_groups, 1u) + 1u == group_count;
        if (is_last_group) finished_groups = 0u;  // for the next frame
    }
    barrier();
    if (!is_last_group) return;
    memoryBarrierImage();
    ivec2 tiles = (extent_of(6u) + 63) / 64;
    for (int y = 0; y < tiles.y; ++y)
        for (int x = 0; x < tiles.x; ++x) {
            reduce_source(6u, ivec2(x, y));
            reduce_tile(7u, ivec2(x, y));
        }
}
