#include "groundtruth/scene/alpha_mask.h"

#include "core/shared/alpha_mask.h"
#include "groundtruth/scene/texture_lookup.h"

bool is_cut_out(const Material& material, const Texture* texture, const Mesh& mesh, const uint32_t* corner, float u,
                float v) {
    if (material.alpha_mode != AlphaMode::mask) return false;
    const Vertex &a = mesh.vertices[corner[0]], &b = mesh.vertices[corner[1]], &c = mesh.vertices[corner[2]];
    // Differences, so that three equal values give that value to the bit.
    float alpha = material.alpha * (a.color.a + u * (b.color.a - a.color.a) + v * (c.color.a - a.color.a));
    if (texture) {
        const TextureSlot& slot = material.base_color_texture;
        const float w = 1.0f - u - v;
        const glm::vec2 uv = w * a.uv[slot.texcoord] + u * b.uv[slot.texcoord] + v * c.uv[slot.texcoord];
        alpha *= sample_texture(*texture, glm::vec2(slot.uv_transform * glm::vec3(uv, 1.0f))).a;
    }
    return is_below_cutoff(alpha, material.alpha_cutoff);
}
