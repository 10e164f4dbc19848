// Values of the parameter inward_rays.
#ifndef COMMON_INWARD_RAYS_GLSL
#define COMMON_INWARD_RAYS_GLSL
const uint inward_rays_missed = 1u, inward_rays_black = 2u;
#endif
