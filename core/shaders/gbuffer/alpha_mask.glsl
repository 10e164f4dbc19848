// Alpha masks (glTF 2.0, section 3.9.4), as the path tracer cuts them out.
#include "core/shared/alpha_mask.h"

layout(location = 10) flat in float common_alpha;

// Whether the mask leaves nothing of this fragment. Vertex colours of one alpha are not interpolated: hardware does it with
// rounding errors that grow with the perspective, and would cut holes where alpha is the cutoff.
bool is_cut_out(DrawnMaterial m, float interpolated_alpha, float texel_alpha) {
    float vertex_alpha = common_alpha >= 0.0 ? common_alpha : interpolated_alpha;
    return is_below_cutoff(m.base_color.a * vertex_alpha * texel_alpha, m.factors.w);
}
