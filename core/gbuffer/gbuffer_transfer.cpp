#include "core/gbuffer/gbuffer_transfer.h"

#include "core/error.h"
#include "core/gbuffer/gbuffer_images.h"
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
    GBuffer gbuffer;
    for (const GBufferImage& image : gbuffer_images())
        if (!image.is_optional || !(g.*image.pixels).values.empty())
            gbuffer.*image.image = uploaded(pass_list, image.name, image.exact, g.*image.pixels);
    if (!g.lit_without_specular.values.empty())
        gbuffer.lit_without_specular =
            uploaded(pass_list, "lit_without_specular", Format::rgba32f, g.lit_without_specular);
    gbuffer.has_dielectric_f0 = !g.dielectric_f0.values.empty();
    if (!gbuffer.has_dielectric_f0) gbuffer.dielectric_f0 = one_dielectric_f0(pass_list);
    return gbuffer;
}
