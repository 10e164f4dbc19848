// The reprojection with the output of reproject.comp, from strips of pixels.
#include "amd_sssr/denoiser_history_output.glsl"
#include "amd_sssr/denoiser_shared_average.glsl"
#include "amd_sssr/denoiser_strip_moments.glsl"

uniform sampler2D radiance;

vec4 strip_neighbor(ivec2 pixel) { return counted(texelFetch(radiance, pixel, 0).rgb); }

// Loops that most threads leave after one step: lavapipe runs both sides of every branch, whether any thread takes them or
// not, but it leaves a loop as soon as no thread is in it.

// Where all colours are nearly the same, their variance is what the sums' rounding has left, and so is the answer of
// is_plausible(). For the same answer the sums are then taken in the order of the faithful form.
Neighborhood in_original_order(ivec2 pixel, bool is_wanted, Neighborhood around) {
    Moments sum = no_moments;
    int i = 0;
    do {
        ivec2 offset = ivec2(i % 9, i / 9) - reach;
        if (is_wanted) {
            vec4 color = is_in_image(pixel + offset) ? strip_neighbor(pixel + offset) : outside_color;
            add_neighbor(color, kernel_weight(offset.x) * kernel_weight(offset.y), sum);
        }
        ++i;
    } while (is_wanted && i < 81);
    if (is_wanted) around = neighborhood_of(sum);
    return around;
}

// As in reproject.comp, but that radiance and depth are looked up once.
History first_history(ivec2 pixel, Surface surface, Neighborhood around) {
    Candidate candidate = candidate_at(surface, surface.reflected_uv);
    Candidate on_surface = candidate_at(surface, surface.surface_uv);
    bool is_reflected = is_better(candidate, on_surface);
    if (!is_reflected) candidate = on_surface;
    vec3 found = textureLod(previous_radiance, candidate.uv, 0.0).rgb;
    // Sums of 81 terms differ by up to 81 * 2^-24 = 5e-6 of themselves.
    float doubt = 1e-5 * surface_discard_variance_weight * dot(around.mean, around.mean);
    float margin = squared_distance(found, around.mean) - surface_discard_variance_weight * length(around.variance);
    around = in_original_order(pixel, !is_reflected && abs(margin) < doubt, around);
    float factor = sameness_at(surface, candidate.uv, candidate.ws_normal);
    return History(candidate.uv, found, is_reflected || is_plausible(found, around) ? factor : history_rejected);
}

History find_history(ivec2 pixel, Surface surface, Neighborhood around) {
    History history = first_history(pixel, surface, around);
    bool is_searching = history.factor != history_rejected && history.factor < disocclusion_threshold;
    int i = 0;
    do {
        if (is_searching) look_nearby(surface, i, history);
        ++i;
    } while (is_searching && i < 9);
    if (is_searching) history.radiance = textureLod(previous_radiance, history.uv, 0.0).rgb;
    is_searching = is_searching && history.factor < disocclusion_threshold;
    SameTexels sum = SameTexels(vec3(0.0), vec3(0.0), 0.0, 0.0);
    i = 0;
    do {
        if (is_searching) add_texel(surface, history.uv, i, sum);
        ++i;
    } while (is_searching && i < 4);
    if (is_searching) history = history_of(sum, surface, history.uv);
    return history;
}

void main() {
    ivec2 first = strip_start();
    Neighborhood around[8] = strip_neighborhoods(first);
    int y = 0;
    do {
        ivec2 pixel = first + ivec2(0, y);
        float alpha = texel(roughness, pixel).r;
        vec4 color = texel(radiance, pixel);
        vec3 averaged = color.rgb;
        if (is_in_image(pixel) && is_glossy(alpha)) {
            History history = find_history(pixel, surface_of(pixel, alpha, color.w), around[y]);
            averaged = store_history(pixel, alpha, color.rgb, history);
        }
        share_for_average(y, weighted_for_average(pixel, averaged));
        ++y;
    } while (y < 8);
    average_tile(first);
}
