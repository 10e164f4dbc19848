// What the lobe is worth in given directions: the density of drawing it, the weight of a draw, and the BRDF.
#include "experiments/study/stability/precision/lobe_arguments.glsl"

uniform sampler2D direction;
uniform writeonly image2D density, weight, brdf;

void main() {
    vec3 o = viewer(), i = texelFetch(direction, pixel(), 0).xyz;
    imageStore(density, pixel(), vec4(lobe_density(lobe_of_visible_normals, o, i, alpha)));
    imageStore(weight, pixel(), vec4(ggx_reflection_weight(o.z, i.z, alpha)));
    imageStore(brdf, pixel(), vec4(ggx_specular(o, i, alpha)));
}
