// direction: drawn from the lobe of visible normals.
#include "experiments/study/stability/precision/lobe_arguments.glsl"

uniform writeonly image2D direction;

void main() {
    LobeSample drawn = sample_lobe(lobe_of_visible_normals, viewer(), alpha, 0.0, random_numbers());
    imageStore(direction, pixel(), vec4(drawn.direction, 0.0));
}
