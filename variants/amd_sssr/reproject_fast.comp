// The reprojection, with the same output as reproject.comp, from strips of pixels.
#include "amd_sssr/denoiser_history_output.glsl"
#include "amd_sssr/denoiser_shared_average.glsl"
#include "amd_sssr/denoiser_strip_moments.glsl"

uniform sampler2D radiance;

vec4 strip_neighbor(ivec2 pixel) { return counted(texelFetch(radiance, pixel, 0).rgb); }

// lavapipe runs both sides of every branch, whether any thread takes them or not, but it leaves a loop as soon as no
// thread is in it. So all that few pixels need is done in loops: of a strip, first the pixels that the first look-up
// settles.

// A look-up of the last frame, and whether it may be taken as it is.
struct Lookup {
    History history;
    bool must_be_plausible, is_doubtful;
};

// As in reproject.comp, but that radiance and depth are looked up once.
Lookup first_lookup(Surface surface, Neighborhood around) {
    Candidate candidate = candidate_at(surface, surface.reflected_uv);
    Candidate on_surface = candidate_at(surface, surface.surface_uv);
    bool is_reflected = is_better(surface, candidate, on_surface);
    if (!is_reflected) candidate = on_surface;
    vec3 found = textureLod(previous_radiance, candidate.uv, 0.0).rgb;
    // Where all colours are nearly the same, their variance is what the rounding of sums has left, and so is the answer
    // of is_plausible(). Sums of 81 terms differ by up to 81 * 2^-24 = 5e-6 of themselves.
    float doubt = 1e-5 * surface_discard_variance_weight * dot(around.mean, around.mean);
    float margin = squared_distance(found, around.mean) - surface_discard_variance_weight * length(around.variance);
    return Lookup(History(candidate.uv, found, sameness_at(surface, candidate.uv, candidate.ws_normal)), !is_reflected,
                  !is_reflected && abs(margin) < doubt);
}

bool is_rejected(Lookup lookup, Neighborhood around) {
    return lookup.must_be_plausible && !is_plausible(lookup.history.radiance, around);
}

bool is_settled(Lookup lookup, Neighborhood around) {
    return !lookup.is_doubtful &&
           (lookup.history.factor >= disocclusion_threshold || is_rejected(lookup, around));
}

// The sums in the order of the faithful form, for the same answer of is_plausible().
Neighborhood in_original_order(ivec2 pixel) {
    Moments sum = no_moments;
    for (int i = 0; i < 81; ++i) {
        ivec2 offset = ivec2(i % 9, i / 9) - reach;
        vec4 color = is_on_screen(pixel + offset) ? strip_neighbor(pixel + offset) : outside_color;
        add_neighbor(color, kernel_weight(offset.x) * kernel_weight(offset.y), sum);
    }
    return neighborhood_of(sum);
}

History find_history(ivec2 pixel, Surface surface, Neighborhood around) {
    Lookup lookup = first_lookup(surface, around);
    if (lookup.is_doubtful) around = in_original_order(pixel);
    History history = lookup.history;
    bool is_searching = !is_rejected(lookup, around) && history.factor < disocclusion_threshold;
    if (is_rejected(lookup, around)) history.factor = history_rejected;
    for (int i = 0; is_searching && i < 9; ++i) look_nearby(surface, i, history);
    if (is_searching) history.radiance = textureLod(previous_radiance, history.uv, 0.0).rgb;
    is_searching = is_searching && history.factor < disocclusion_threshold;
    SameTexels sum = SameTexels(vec3(0.0), vec3(0.0), 0.0, 0.0);
    for (int i = 0; is_searching && i < 4; ++i) add_texel(surface, history.uv, i, sum);
    if (is_searching) history = history_of(sum, surface, history.uv);
    return history;
}

void main() {
    ivec2 first = strip_start();
    Neighborhood around[8] = strip_neighborhoods(first);
    uint open_pixels = 0u;  // bit y: pixel y of the strip
    int y = 0;
    do {
        ivec2 pixel = first + ivec2(0, y);
        float alpha = texel(roughness, pixel).r;
        vec4 color = texel(radiance, pixel);
        vec3 averaged = color.rgb;
        if (is_on_screen(pixel) && is_glossy(alpha)) {
            Lookup lookup = first_lookup(surface_of(pixel, alpha, color.w), around[y]);
            if (is_rejected(lookup, around[y])) lookup.history.factor = history_rejected;
            if (is_settled(lookup, around[y]))
                averaged = store_history(pixel, alpha, color.rgb, lookup.history);
            else
                open_pixels |= 1u << y;
        }
        share_for_average(y, weighted_for_average(pixel, averaged));
        ++y;
    } while (y < 8);
    while (open_pixels != 0u) {
        y = findLSB(open_pixels);
        ivec2 pixel = first + ivec2(0, y);
        float alpha = texelFetch(roughness, pixel, 0).r;
        vec4 color = texelFetch(radiance, pixel, 0);
        History history = find_history(pixel, surface_of(pixel, alpha, color.w), around[y]);
        share_for_average(y, weighted_for_average(pixel, store_history(pixel, alpha, color.rgb, history)));
        open_pixels &= open_pixels - 1u;
    }
    average_tile(first);
}
