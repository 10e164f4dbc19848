// One ray of each pixel as images: ray_radiance and ray_direction of denoiser.h. With several rays per pixel, another
// one every frame.
#include "denoisers/seen.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D ray_radiance, ray_direction;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 radiance = vec4(0.0), direction = vec4(0.0);
    TracedRay ray = load_ray(index_of_ray(traced_of_pixel(pixel), camera.frame.x % max_rays));
    bool is_traced = ray.inverse_density != 0.0 && ray.target != ray_below_horizon;
    if (is_traced && reflects(pixel, max_roughness)) {
        Seen seen = seen_by(pixel, ray);
        float ray_length = is_hit(ray) ? ray.ray_length : camera.depth.y;
        radiance = vec4(seen.confidence * seen.radiance, seen.confidence);
        direction = vec4(mat3(camera.world_from_view) * ray.direction * ray_length,
                         (1.0 - importance_bias) / ray.inverse_density);
    }
    imageStore(ray_radiance, pixel, radiance);
    imageStore(ray_direction, pixel, direction);
}
