#include "core/gbuffer/scene_facts.h"
#include "core/number_text.h"
#include "core/shared/brdf.h"

#include <algorithm>

PixelFacts pixel_facts(const HostGBuffer& g) {
    PixelFacts facts;
    const glm::vec2 extent(g.extent());
    const float share = 1.0f / float(g.depth.pixel_count());
    size_t background = 0, reflective = 0, mirror = 0, moving = 0;
    for (size_t i = 0; i < g.depth.pixel_count(); ++i) {
        if (g.depth.values[i] == g.camera.depth.z) {
            ++background;
            continue;
        }
        moving += glm::length(glm::vec2(g.motion.values[2 * i], g.motion.values[2 * i + 1]) * extent) > 0.01f;
        const float metalness = g.base_color.values[4 * i + 3], specular = g.emission.values[4 * i + 3];
        if (!(specular_f90(metalness, specular) > 0)) continue;
        const float roughness = g.normal.values[4 * i + 3];
        ++reflective;
        mirror += roughness * roughness <= min_ggx_alpha;
        facts.min_roughness = std::min(facts.min_roughness, roughness);
        facts.max_roughness = std::max(facts.max_roughness, roughness);
    }
    facts.background = background * share;
    facts.reflective = reflective * share;
    facts.mirror = mirror * share;
    facts.moving = moving * share;
    return facts;
}

std::vector<SceneFact> list_facts(const PixelFacts& facts) {
    const auto percent = [](float share) { return fixed_text(100 * share, 1) + " %"; };
    return {{"background_pixels", percent(facts.background), "nothing is drawn there"},
            {"reflective_pixels", percent(facts.reflective), "their specular reflectance is not zero"},
            {"mirror_pixels", percent(facts.mirror), "reflective and not rougher than a mirror"},
            {"moving_pixels", percent(facts.moving),
             "surfaces that move by more than 1/100 of a pixel since the frame before"}};
}
