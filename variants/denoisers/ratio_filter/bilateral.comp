// Averages neighbours on a pixel's plane where accumulated values still scatter.
#include "common/mirror_ray.glsl"
#include "denoisers/ratio_filter/averages.glsl"
#include "denoisers/ratio_filter/kernel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D accumulated, accumulated_variance;
uniform writeonly image2D reflections;

// In which bright colours count less.
vec3 dimmed(vec3 color) { return is_logarithmic ? logarithm_of(color) : color / (1.0 + color.r + color.g + color.b); }
vec3 undimmed(vec3 value) {
    const float largest_sum = 1.0 - 1e-6;
    if (is_logarithmic) return color_of_logarithm(value);
    return value / (1.0 - min(value.r + value.g + value.b, largest_sum));
}

struct Size {
    uint count;   // of neighbours
    float width;  // of their square (pixels)
};

Size size_of(float roughness, float variance) {
    const bool grows_by_variance = bilateral_size == 0u;
    float rough = width_share(roughness), scatter = clamp(2.0 * variance, 0.0, 1.0);
    if (grows_by_variance) return Size(uint(mix(1.0, 15.0, scatter)), bilateral_width * rough * scatter);
    return Size(uint(mix(1.0, 10.0, rough) * (variance > 0.5 ? 1.5 : 1.0)), bilateral_width * rough);
}

float weight_of(ivec2 pixel, ivec2 neighbor, vec3 position, vec3 vs_normal, float width) {
    float off_plane = dot(vs_normal, view_position(neighbor) - position);
    if (scale_free) off_plane /= max(abs(position.z), 1e-6);
    float by_plane = exp2(-1e4 * off_plane * off_plane);
    vec2 offset = vec2(neighbor - pixel);
    float by_place = exp(-1.5 * dot(offset, offset) / max(width * width, 1e-6));
    float cosine = dot(vs_normal, view_normal(neighbor)), square = cosine * cosine, fourth = square * square;
    return by_plane * by_place * min(fourth * fourth, 1.0);
}

vec4 filtered(ivec2 pixel, vec4 color, float roughness, float variance) {
    vec3 position = view_position(pixel), vs_normal = view_normal(pixel);
    Size size = size_of(roughness, variance);
    vec2 random = random_pair(pixel, 0u, bilateral_dimension);
    Running known = no_values, confidence = no_values;
    add_value(known, color.a, dimmed(known_color(color)));
    add_value(confidence, 1.0, color.aaa);
    for (uint i = 0u; i < size.count; ++i) {
        ivec2 neighbor = pixel + box_offset(i, size.count, random, size.width);
        if (!is_on_screen(neighbor)) continue;
        vec4 shown = texelFetch(accumulated, neighbor, 0);
        if (!is_reflection(shown)) continue;
        float weight = weight_of(pixel, neighbor, position, vs_normal, size.width);
        add_value(known, weight * shown.a, dimmed(known_color(shown)));
        add_value(confidence, weight, shown.aaa);
    }
    return vec4(max(undimmed(known.mean), 0.0), min(confidence.mean.x, 1.0));  // of what rounding leaves
}

void main() {
    const float least_roughness = 0.05;  // EEVEE's: sharp reflections are left alone
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 shown = texelFetch(accumulated, pixel, 0), result = vec4(0.0);
    if (is_reflection(shown)) {
        float roughness = texelFetch(normal, pixel, 0).w, variance = texelFetch(accumulated_variance, pixel, 0).r;
        bool is_filtered = bilateral_filter && roughness >= least_roughness && variance >= bilateral_variance;
        result = is_filtered ? filtered(pixel, shown, roughness, variance) : vec4(known_color(shown), shown.a);
    }
    imageStore(reflections, pixel, result);
}
