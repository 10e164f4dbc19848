#pragma once
#include "core/scene/scene.h"

/// Whether the alpha mask of a material (glTF 2.0, section 3.9.4) leaves nothing of a triangle at barycentrics (u, v),
/// for rays and for light samples alike. `corner`: the triangle's three vertices in the mesh. `texture`: the material's
/// base colour texture, or nullptr. Always false without AlphaMode::mask.
bool is_cut_out(const Material& material, const Texture* texture, const Mesh& mesh, const uint32_t* corner, float u,
                float v);
