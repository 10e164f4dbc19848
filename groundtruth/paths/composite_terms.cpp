#include "groundtruth/paths/composite_terms.h"

#include "core/split_sum.h"

#include <tbb/task_arena.h>

namespace {

/// Made once. Isolated, since a thread that waits for it must not begin other work that waits for it too.
const HostImage& split_sum_factors() {
    static const HostImage table = tbb::this_task_arena::isolate([] { return split_sum_table(); });
    return table;
}

}  // namespace

CompositeTerms::CompositeTerms(const TracedScene& scene)
    : scene_(scene), prefiltered_(prefilter_environment(scene.scene.environment)), split_sum_(split_sum_factors()) {}

void CompositeTerms::add_to(FirstHit& hit) const {
    hit.fallback =
        mean_over_lobe(scene_.scene.environment, prefiltered_, reflect(-hit.view, hit.normal), hit.roughness);
    const float mu_o = dot(hit.normal, hit.view);
    if (mu_o <= 0 || hit.is_unlit) return;
    const glm::vec2 ab = read_split_sum(split_sum_, mu_o, hit.roughness);
    const glm::vec3 f0 = scene_.materials.any_dielectric_f0()
                             ? specular_f0(hit.base_color, hit.metalness, hit.specular, hit.dielectric_f0)
                             : specular_f0(hit.base_color, hit.metalness, hit.specular);
    hit.reflectance = f0 * ab.x + specular_f90(hit.metalness, hit.specular) * ab.y;
}
