// AMD FidelityFX Denoiser 1.3 (reflections), first pass, laid out as the original: history and its confidence for every
// glossy pixel, and the average radiance of the tile.
#include "amd_sssr/denoiser_history.glsl"
#include "amd_sssr/denoiser_history_output.glsl"
#include "amd_sssr/denoiser_shared_halves.glsl"
#include "neighborhood"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D radiance;

void share_neighborhood(ivec2 pixel, ivec2 local) {
    for (int i = 0; i < 4; ++i) {
        ivec2 block = ivec2(i & 1, i >> 1) * 8;
        share_color(local + block, counted(texel(radiance, pixel - reach + block).rgb));
    }
}

History first_history(Surface surface, Neighborhood around) {
    Candidate reflected = candidate_at(surface, surface.reflected_uv);
    Candidate on_surface = candidate_at(surface, surface.surface_uv);
    if (is_better(surface, reflected, on_surface))
        return History(reflected.uv, textureLod(previous_radiance, reflected.uv, 0.0).rgb,
                       sameness_at(surface, reflected.uv, reflected.ws_normal));
    vec3 found = textureLod(previous_radiance, on_surface.uv, 0.0).rgb;
    float factor = sameness_at(surface, on_surface.uv, on_surface.ws_normal);
    return History(on_surface.uv, found, is_plausible(found, around) ? factor : history_rejected);
}

History find_history(Surface surface, Neighborhood around) {
    History history = first_history(surface, around);
    if (history.factor == history_rejected) return history;
    if (history.factor < disocclusion_threshold) {
        for (int i = 0; i < 9; ++i) look_nearby(surface, i, history);
        history.radiance = textureLod(previous_radiance, history.uv, 0.0).rgb;
    }
    if (history.factor < disocclusion_threshold) {
        SameTexels sum = SameTexels(vec3(0.0), vec3(0.0), 0.0, 0.0);
        for (int i = 0; i < 4; ++i) add_texel(surface, history.uv, i, sum);
        history = history_of(sum, surface, history.uv);
    }
    return history;
}

const uint denoiser_form_by_device = 0u;

void main() {
    ivec2 local = ivec2(gl_LocalInvocationID.xy), pixel = tile_start(group_index()) + local;
    share_neighborhood(pixel, local);
    barrier();
    float alpha = texel(roughness, pixel).r;
    vec4 color = texel(radiance, pixel);
    vec3 averaged = color.rgb;
    if (is_on_screen(pixel) && is_glossy(alpha)) {
        History history = find_history(surface_of(pixel, alpha, color.w), neighborhood_at(local + reach));
        averaged = store_history(pixel, alpha, color.rgb, history);
    }
    if (barrier_before_average || denoiser_form == denoiser_form_by_device) barrier();

    share_color(local, weighted_for_average(pixel, averaged));
    barrier();
    for (int size = 2; size <= 8; size *= 2) {
        ivec2 near = local * size, far = near + size / 2;
        if (max(far.x, far.y) < 8)
            share_color(near, shared_color_at(near) + shared_color_at(ivec2(far.x, near.y)) +
                                  shared_color_at(ivec2(near.x, far.y)) + shared_color_at(far));
        barrier();
    }
    if (local == ivec2(0) && is_on_screen(pixel)) store_average(pixel / 8, shared_color_at(ivec2(0)));
}
