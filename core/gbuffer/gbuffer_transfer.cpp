#include "core/gbuffer/gbuffer_transfer.h"

#include "core/error.h"
#include "core/shared/brdf.h"

namespace {

Image uploaded(PassList& pass_list, const std::string& name, Format format, const HostImage& pixels) {
    const Image image = pass_list.image(name, format);
    if (pixels.values.empty())
        pass_list.clear(image, glm::vec4(0));
    else
        pass_list.upload(image, pixels);
    return image;
}

}  // namespace

HostGBuffer download_gbuffer(PassList& pass_list, const GBuffer& g, const CameraData& camera,
                             DepthFormat depth_format) {
    HostGBuffer host{.camera = camera,
                     .depth_format = depth_format,
                     .depth = pass_list.download(g.depth),
                     .geometric_normal = pass_list.download(g.geometric_normal),
                     .normal = pass_list.download(g.normal),
                     .base_color = pass_list.download(g.base_color),
                     .emission = pass_list.download(g.emission),
                     .motion = pass_list.download(g.motion),
                     .material_id = pass_list.download(g.material_id),
                     .previous_depth = pass_list.download(g.previous_depth),
                     .previous_normal = pass_list.download(g.previous_normal),
                     .lit = pass_list.download(g.lit),
                     .fallback = pass_list.download(g.fallback)};
    if (g.second_depth.storage) host.second_depth = pass_list.download(g.second_depth);
    if (g.back_depth.storage) host.back_depth = pass_list.download(g.back_depth);
    if (g.lit_without_specular.storage) host.lit_without_specular = pass_list.download(g.lit_without_specular);
    if (g.has_dielectric_f0) host.dielectric_f0 = pass_list.download(g.dielectric_f0);
    return host;
}

Image one_dielectric_f0(PassList& pass_list) {
    const Image image = pass_list.image_of("one_dielectric_f0", Format::rgba32f, {1, 1});
    pass_list.clear(image, glm::vec4(glm::vec3(usual_dielectric_f0), 0));
    return image.as("dielectric_f0");
}

GBuffer upload_gbuffer(PassList& pass_list, const HostGBuffer& g) {
    if (pass_list.extent() != g.extent())
        fail("a G-buffer of ", g.extent().x, " x ", g.extent().y, " does not fit the pass list of ",
             pass_list.extent().x, " x ", pass_list.extent().y);
    GBuffer gbuffer{.depth = uploaded(pass_list, "depth", Format::r32f, g.depth),
                    .geometric_normal = uploaded(pass_list, "geometric_normal", Format::rgba32f, g.geometric_normal),
                    .normal = uploaded(pass_list, "normal", Format::rgba32f, g.normal),
                    .base_color = uploaded(pass_list, "base_color", Format::rgba32f, g.base_color),
                    .emission = uploaded(pass_list, "emission", Format::rgba32f, g.emission),
                    .motion = uploaded(pass_list, "motion", Format::rg32f, g.motion),
                    .material_id = uploaded(pass_list, "material_id", Format::r32ui, g.material_id),
                    .previous_depth = uploaded(pass_list, "previous_depth", Format::r32f, g.previous_depth),
                    .previous_normal = uploaded(pass_list, "previous_normal", Format::rgba32f, g.previous_normal),
                    .lit = uploaded(pass_list, "lit", Format::rgba32f, g.lit),
                    .fallback = uploaded(pass_list, "fallback", Format::rgba32f, g.fallback)};
    if (!g.second_depth.values.empty())
        gbuffer.second_depth = uploaded(pass_list, "second_depth", Format::r32f, g.second_depth);
    if (!g.back_depth.values.empty())
        gbuffer.back_depth = uploaded(pass_list, "back_depth", Format::r32f, g.back_depth);
    if (!g.lit_without_specular.values.empty())
        gbuffer.lit_without_specular =
            uploaded(pass_list, "lit_without_specular", Format::rgba32f, g.lit_without_specular);
    gbuffer.has_dielectric_f0 = !g.dielectric_f0.values.empty();
    gbuffer.dielectric_f0 = gbuffer.has_dielectric_f0
                                ? uploaded(pass_list, "dielectric_f0", Format::rgba32f, g.dielectric_f0)
                                : one_dielectric_f0(pass_list);
    return gbuffer;
}
