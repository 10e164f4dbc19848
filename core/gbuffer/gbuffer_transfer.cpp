#include "core/gbuffer/gbuffer_transfer.h"

#include "core/error.h"
#include "core/shared/brdf.h"

namespace {

Image uploaded(PassGraph& graph, const std::string& name, Format format, const HostImage& pixels) {
    const Image image = graph.image(name, format);
    if (pixels.values.empty())
        graph.clear(image, glm::vec4(0));
    else
        graph.upload(image, pixels);
    return image;
}

}  // namespace

HostGBuffer download_gbuffer(PassGraph& graph, const GBuffer& g, const CameraData& camera, DepthFormat depth_format) {
    HostGBuffer host{.camera = camera,
                     .depth_format = depth_format,
                     .depth = graph.download(g.depth),
                     .geometric_normal = graph.download(g.geometric_normal),
                     .normal = graph.download(g.normal),
                     .base_color = graph.download(g.base_color),
                     .emission = graph.download(g.emission),
                     .motion = graph.download(g.motion),
                     .material_id = graph.download(g.material_id),
                     .previous_depth = graph.download(g.previous_depth),
                     .previous_normal = graph.download(g.previous_normal),
                     .lit = graph.download(g.lit),
                     .fallback = graph.download(g.fallback)};
    if (g.second_depth.storage) host.second_depth = graph.download(g.second_depth);
    if (g.back_depth.storage) host.back_depth = graph.download(g.back_depth);
    if (g.lit_without_specular.storage) host.lit_without_specular = graph.download(g.lit_without_specular);
    if (g.has_dielectric_f0) host.dielectric_f0 = graph.download(g.dielectric_f0);
    return host;
}

Image one_dielectric_f0(PassGraph& graph) {
    const Image image = graph.image_of("one_dielectric_f0", Format::rgba32f, {1, 1});
    graph.clear(image, glm::vec4(glm::vec3(usual_dielectric_f0), 0));
    return image.as("dielectric_f0");
}

GBuffer upload_gbuffer(PassGraph& graph, const HostGBuffer& g) {
    if (graph.extent() != g.extent())
        fail("a G-buffer of ", g.extent().x, " x ", g.extent().y, " does not fit the pass graph of ", graph.extent().x,
             " x ", graph.extent().y);
    GBuffer gbuffer{.depth = uploaded(graph, "depth", Format::r32f, g.depth),
                    .geometric_normal = uploaded(graph, "geometric_normal", Format::rgba32f, g.geometric_normal),
                    .normal = uploaded(graph, "normal", Format::rgba32f, g.normal),
                    .base_color = uploaded(graph, "base_color", Format::rgba32f, g.base_color),
                    .emission = uploaded(graph, "emission", Format::rgba32f, g.emission),
                    .motion = uploaded(graph, "motion", Format::rg32f, g.motion),
                    .material_id = uploaded(graph, "material_id", Format::r32ui, g.material_id),
                    .previous_depth = uploaded(graph, "previous_depth", Format::r32f, g.previous_depth),
                    .previous_normal = uploaded(graph, "previous_normal", Format::rgba32f, g.previous_normal),
                    .lit = uploaded(graph, "lit", Format::rgba32f, g.lit),
                    .fallback = uploaded(graph, "fallback", Format::rgba32f, g.fallback)};
    if (!g.second_depth.values.empty())
        gbuffer.second_depth = uploaded(graph, "second_depth", Format::r32f, g.second_depth);
    if (!g.back_depth.values.empty()) gbuffer.back_depth = uploaded(graph, "back_depth", Format::r32f, g.back_depth);
    if (!g.lit_without_specular.values.empty())
        gbuffer.lit_without_specular = uploaded(graph, "lit_without_specular", Format::rgba32f, g.lit_without_specular);
    gbuffer.has_dielectric_f0 = !g.dielectric_f0.values.empty();
    gbuffer.dielectric_f0 = gbuffer.has_dielectric_f0
                                ? uploaded(graph, "dielectric_f0", Format::rgba32f, g.dielectric_f0)
                                : one_dielectric_f0(graph);
    return gbuffer;
}
