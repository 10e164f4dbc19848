// Products of a NaN with a constant 0, of which a driver may make 0, and with a 0 that no compiler knows. `source` holds
// NaN and 0. By hand: 4 products are hidden in `plain`, 3 in `functions`, none in `seen`.
layout(local_size_x = 1) in;
uniform sampler2D source;
uniform writeonly image2D plain, functions, seen;

void main() {
    float nan = texelFetch(source, ivec2(0, 0), 0).r, zero = texelFetch(source, ivec2(1, 0), 0).r;
    float weight = 0.0;
    if (scene_is_still) weight = nan;
    imageStore(plain, ivec2(0), vec4(nan * 0.0, weight * nan, dot(vec2(nan, zero), vec2(0.0, 1.0)), 0.0 / zero));
    imageStore(functions, ivec2(0), vec4(mix(zero, nan, 0.0), fma(nan, 0.0, 1.0), pow(nan, 0.0), camera.depth.x * 0.0));
    imageStore(seen, ivec2(0), vec4(nan * zero, mix(zero, nan, zero), zero / zero, nan * 2.0));
}
