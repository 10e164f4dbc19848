// Decides from its probes how many rays each tile gets: none without a hit, else more rays for more difference or hits.
// The slides say that hits and perceptual variance decide; the rule is ssrlab's.
#include "frostbite_sssr/tile.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D probes, previous_ray_count, previous_frames_left;
uniform writeonly image2D ray_count, frames_left;

float least_rays() { return float(min(min_rays, max_rays)); }

bool is_within(ivec2 texel, ivec2 extent) {
    return all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, extent));
}

struct TileProbes {
    uint count, hits;
    float mean, deviation;  // of the compressed luminance
};

// Sums of differences from the first probe: those of equal probes are exactly 0.
TileProbes probes_of(ivec2 tile) {
    uint count = 0u, hits = 0u;
    float first = 0.0, sum = 0.0, squares = 0.0;
    for (int i = 0; i < blocks_per_tile * blocks_per_tile; ++i) {
        ivec2 block = tile * blocks_per_tile + ivec2(i % blocks_per_tile, i / blocks_per_tile);
        if (!is_within(block, textureSize(probes, 0))) continue;
        vec2 probe = texelFetch(probes, block, 0).xy;
        if (probe.y == no_probe) continue;
        if (count == 0u) first = probe.x;
        float difference = probe.x - first;
        sum += difference;
        squares += difference * difference;
        ++count;
        if (probe.y == probe_hit) ++hits;
    }
    float mean = sum / max(float(count), 1.0);
    float variance = squares / max(float(count), 1.0) - mean * mean;
    return TileProbes(count, hits, first + mean, sqrt(max(variance, 0.0)));
}

bool is_hit_around(ivec2 tile) {
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 neighbor = tile + ivec2(x, y);
            if (is_within(neighbor, imageSize(ray_count)) && probes_of(neighbor).hits > 0u) return true;
        }
    return false;
}

float share_of_rays(TileProbes found) {
    const uint by_deviation = 0u, by_hit_ratio = 1u;  // parameter `rays_by`
    float deviation = clamp(found.deviation / (variance_scale * (found.mean + 0.05)), 0.0, 1.0);
    if (rays_by == by_deviation) return deviation;
    float hit_ratio = float(found.hits) / max(float(found.count), 1.0);
    return rays_by == by_hit_ratio ? hit_ratio : hit_ratio * deviation;
}

uint rays_for(TileProbes found) {
    float share = share_of_rays(found);
    float rays = mix(least_rays(), float(max_rays), share);
    return uint(rays + 0.5);
}

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (!is_within(tile, imageSize(ray_count))) return;
    TileProbes own = probes_of(tile);
    bool is_hit = dilate_tiles ? is_hit_around(tile) : own.hits > 0u;
    float left = texelFetch(previous_frames_left, tile, 0).r;
    float rays = 0.0;
    if (is_hit)
        rays = float(rays_for(own));
    else if (left > 0.0)
        rays = max(texelFetch(previous_ray_count, tile, 0).r, least_rays());
    if (own.count == 0u) rays = 0.0;  // nothing in the tile reflects
    imageStore(ray_count, tile, vec4(rays));
    imageStore(frames_left, tile, vec4(is_hit ? float(hysteresis) : max(left - 1.0, 0.0)));
}
