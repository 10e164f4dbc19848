#include "core/gbuffer/composite.h"

#include "core/shared/brdf.h"
#include "core/split_sum.h"

#include <utility>

namespace {

/// Unit, world space, from the camera through the pixel's sample: pixel.glsl.
glm::vec3 pixel_direction(const CameraData& camera, unsigned x, unsigned y) {
    if (camera.frame.z == 1u) return -glm::normalize(glm::vec3(camera.world_from_view[2]));
    const glm::vec2 uv =
        (glm::vec2(x, y) + 0.5f + glm::vec2(camera.jitter)) * glm::vec2(camera.extent.z, camera.extent.w);
    const glm::vec4 point = camera.view_from_clip * glm::vec4(uv * 2.0f - 1.0f, 0.5f, 1.0f);
    return glm::mat3(camera.world_from_view) * glm::normalize(glm::vec3(point) / point.w);
}

}  // namespace

Composite Compositor::render(const GBuffer& g, const Reflections& reflections) {
    const Composite result{pass_list_.image("specular", Format::rgba32f), pass_list_.image("image", Format::rgba32f)};
    auto pass = pass_list_.compute("gbuffer/composite.comp");
    for (const Image& image :
         {g.depth, g.normal, g.base_color, g.emission, g.dielectric_f0, g.fallback, split_sum_.on(pass_list_)})
        pass.read(image);
    pass.read((g.lit_without_specular.storage ? g.lit_without_specular : g.lit).as("lit"))
        .read(reflections.radiance.as("radiance"))
        .read(reflections.confidence.as("confidence"))
        .set("confidence_channel", reflections.confidence_channel)
        .set("adds_fresnel", unsigned(formula_ == CompositeFormula::additive_fresnel))
        .write(result.image)
        .write(result.specular)
        .run();
    return result;
}

void Compositor::add_environment(GBuffer& gbuffer) {
    const Image none = pass_list_.image("no_confidence", Format::r8);
    pass_list_.clear(none, glm::vec4(0));
    const Image with = render(gbuffer, {gbuffer.fallback, none}).image;
    pass_list_.times();
    gbuffer.lit_without_specular = std::exchange(gbuffer.lit, with.as("lit")).as("lit_without_specular");
}

HostImage specular_reflectance(const HostGBuffer& g) {
    HostImage result(g.extent(), 3);
    for (unsigned y = 0; y < g.extent().y; ++y)
        for (unsigned x = 0; x < g.extent().x; ++x) {
            if (*g.depth.pixel(x, y) == g.camera.depth.z) continue;
            const float *n = g.normal.pixel(x, y), *c = g.base_color.pixel(x, y);
            const float specular = g.emission.pixel(x, y)[3];
            const float mu_o = -glm::dot(glm::vec3(n[0], n[1], n[2]), pixel_direction(g.camera, x, y));
            if (mu_o <= 0) continue;
            const glm::vec2 ab = read_split_sum(default_split_sum_table(), mu_o, n[3]);
            const glm::vec3 own_f0 = g.dielectric_f0.values.empty() ? glm::vec3(usual_dielectric_f0)
                                                                    : g.dielectric_f0.rgb(size_t(y) * g.extent().x + x);
            const glm::vec3 f0 = specular_f0({c[0], c[1], c[2]}, c[3], specular, own_f0);
            result.set_rgb(size_t(y) * g.extent().x + x, f0 * ab.x + specular_f90(c[3], specular) * ab.y);
        }
    return result;
}
