// The buffer `seen_rays` (denoiser.h), by index of the ray (ray.glsl): rgb radiance, not negative; a share of it that
// is known.
#ifndef DENOISERS_SEEN_RAYS_GLSL
#define DENOISERS_SEEN_RAYS_GLSL
buffer seen_rays { vec4 seen_by_ray[]; };
#endif
