// Interpolates history between its texels.
#include "core/shaders/view.glsl"

uniform sampler2D previous_accumulated_radiance, previous_accumulated_variance;

// The 2x2 texels around a position, of which bilinear filtering makes a value there.
struct Taps {
    ivec2 first;
    vec2 share;  // of the right and the lower texels
};

Taps taps_at(vec2 position) {
    vec2 corner = floor(position - 0.5);
    return Taps(ivec2(corner), position - 0.5 - corner);
}

ivec2 texel_of(Taps taps, int i) { return taps.first + ivec2(i & 1, i >> 1); }

float weight_of(Taps taps, int i) {
    vec2 weight = mix(1.0 - taps.share, taps.share, vec2(float(i & 1), float(i >> 1)));
    return weight.x * weight.y;
}

ivec2 clamped_to_screen(ivec2 texel) { return clamp(texel, ivec2(0), ivec2(camera.extent.xy) - 1); }

// Where WebGL 2 filters no 32-bit floats.
vec4 filtered(sampler2D image, vec2 position) {
    Taps taps = taps_at(position);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i)
        sum += weight_of(taps, i) * texelFetch(image, clamped_to_screen(texel_of(taps, i)), 0);
    return sum;
}

vec4 radiance_before(vec2 position) {
    return float_histories ? filtered(previous_accumulated_radiance, position)
                           : textureLod(previous_accumulated_radiance, position * camera.extent.zw, 0.0);
}

float variance_before(vec2 position) {
    return float_histories ? filtered(previous_accumulated_variance, position).r
                           : textureLod(previous_accumulated_variance, position * camera.extent.zw, 0.0).r;
}
