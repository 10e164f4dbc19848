#include "variants/diligent_ssr/passes.h"

#include "core/gbuffer/environment_images.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace {

constexpr unsigned kept_stencil = 255;

}  // namespace

Image diligent_target(PassGraph& graph, const std::string& name, Format format, glm::uvec2 extent, bool is_cleared) {
    const Image target = graph.image_black_at_first(name, format, extent);
    if (is_cleared) graph.clear(target, {});
    return target;
}

void draw_mask(PassGraph::Pass& pass, const Image& mask) {
    if (mask.format == Format::d16)
        pass.depth({.compare = DepthTest::Compare::always, .is_written = true, .image = mask});
    else
        pass.stencil({.mode = Stencil::Mode::write, .value = kept_stencil, .image = mask});
    pass.run();
}

void draw_masked(PassGraph::Pass& pass, const Image& mask) {
    // Kept pixels hold a depth of 1; the triangle lies at depth 0.
    if (mask.format == Format::d16)
        pass.depth({.compare = DepthTest::Compare::less, .is_written = false, .image = mask});
    else
        pass.stencil({.mode = Stencil::Mode::keep_equal, .value = kept_stencil, .image = mask});
    pass.run();
}

Image diligent_reprojected_depth(PassGraph& graph, const GBuffer& gbuffer) {
    const Image reprojected = graph.image("reprojected_depth", Format::r32f);
    graph.fragment("diligent_ssr/reprojected_depth.frag").read(gbuffer.depth).write(reprojected).run();
    return reprojected;
}

namespace {

const std::string stage = "diligent_ssr/depth_hierarchy";

void copy_level(PassGraph& graph, const Image& source, const Image& target, unsigned level) {
    graph.fragment("diligent_ssr/copy_level.frag")
        .label(stage)
        .read(source.as("copied"))
        .write(target.mip(level).as("copied_depth"))
        .set("level", int(level))
        .run();
}

void copy_surfaces(PassGraph& graph, const Image& depth, const Image& target) {
    graph.fragment("diligent_ssr/copy_surfaces.frag")
        .label(stage)
        .read(depth.as("copied"))
        .write(target.as("copied_depth"))
        .run();
}

/// `finer_level`: of the image `finer`, which is that level alone or the whole chain.
void draw_level(PassGraph& graph, const Image& finer, unsigned finer_level, const Image& target, bool keeps_farthest) {
    graph.fragment("diligent_ssr/depth_hierarchy.frag")
        .label(stage)
        .read(finer.as("finer_depth"))
        .write(target.as("kept_depth"))
        .set("finer_level", int(finer_level))
        .set("keeps_farthest", int(keeps_farthest))
        .run();
}

Image depth_hierarchy(PassGraph& graph, const Image& depth, unsigned max_mips, bool keeps_farthest,
                      bool has_mip_views) {
    const glm::uvec2 extent = depth.extent;
    const unsigned mips = std::min(max_mips, unsigned(std::bit_width(std::max(extent.x, extent.y))));
    const std::string name = keeps_farthest ? "farthest_depth_pyramid" : "depth_pyramid";
    const Image hierarchy = graph.image_of(name, Format::r32f, extent, mips);
    if (keeps_farthest)
        copy_surfaces(graph, depth, hierarchy.mip(0));
    else
        copy_level(graph, depth, hierarchy, 0);
    if (has_mip_views) {
        for (unsigned level = 1; level < mips; ++level)
            draw_level(graph, hierarchy.mip(level - 1), 0, hierarchy.mip(level), keeps_farthest);
        return hierarchy;
    }
    // The original copies the last level, too, which nothing reads.
    const Image intermediate = graph.image_of(name + "_intermediate", Format::r32f, extent, mips);
    for (unsigned level = 1; level < mips; ++level) {
        copy_level(graph, hierarchy, intermediate, level - 1);
        draw_level(graph, intermediate, level - 1, hierarchy.mip(level), keeps_farthest);
    }
    return hierarchy;
}

}  // namespace

Tracers::Images diligent_depth_hierarchies(PassGraph& graph, const GBuffer& gbuffer,
                                           const DiligentTracingParameters& parameters) {
    const bool has_mip_views = parameters.hierarchy.is("mip_views");
    return parameters.tracers.images(graph, gbuffer.depth,
                                     [&](PassGraph&, const Image& depth, unsigned mips, bool keeps_farthest) {
                                         return depth_hierarchy(graph, depth, mips, keeps_farthest, has_mip_views);
                                     });
}

namespace {

Image cleared_mask(PassGraph& graph, const std::string& name, const DiligentTracingParameters& parameters,
                   unsigned divisor) {
    const Image mask = graph.image(name, parameters.mask.is("stencil") ? Format::d32f_s8 : Format::d16, 1, divisor);
    graph.clear(mask, {});
    return mask;
}

Image roughness_target(PassGraph& graph, bool is_float, bool is_cleared) {
    const Image roughness =
        graph.image_black_at_first("roughness", is_float ? Format::r32f : Format::r8, graph.extent());
    if (is_cleared) graph.clear(roughness, glm::vec4(1.0f));  // what is left out counts as rough
    return roughness;
}

}  // namespace

DiligentMask diligent_mask(PassGraph& graph, const GBuffer& gbuffer, const DiligentTracingParameters& tracing,
                           const DiligentFilterParameters& filter) {
    const Image roughness = roughness_target(graph, tracing.float_roughness, filter.clear_targets);
    const Image full = cleared_mask(graph, "mask", tracing, 1);
    auto pass = graph.fragment("diligent_ssr/mask.frag");
    pass.read(gbuffer.depth).read(gbuffer.normal).read(gbuffer.base_color).read(gbuffer.emission).write(roughness);
    draw_mask(pass, full);
    if (!tracing.half_resolution) return {roughness, full, full};

    const Image half = cleared_mask(graph, "half_resolution_mask", tracing, 2);
    auto half_pass = graph.fragment("diligent_ssr/half_resolution_mask.frag");
    half_pass.read(gbuffer.depth).read(roughness);
    draw_mask(half_pass, half);
    return {roughness, full, half};
}

float diligent_roughness_of_8_bits(float perceptual) {
    return std::floor(perceptual * 255.0f + 0.5f) * (1.0f / 255.0f);  // as mask.frag
}

DiligentRays diligent_trace(PassGraph& graph, const GBuffer& gbuffer, const Tracers::Images& hierarchies,
                            const Image& noise, const Image& color, const DiligentMask& mask,
                            const DiligentTracingParameters& parameters, RayProbe* probe) {
    const Format format = parameters.float_rays ? Format::rgba32f : Format::rgba16f;
    const DiligentRays rays{.radiance = diligent_target(graph, "ray_radiance", format, mask.traced.extent, true),
                            .direction = diligent_target(graph, "ray_direction", format, mask.traced.extent, true)};
    auto pass = graph.fragment("diligent_ssr/intersection.frag");
    pass.read(noise)
        .read(color.as("hit_color"))
        .read(mask.roughness)
        .read(gbuffer.normal)
        .read(gbuffer.geometric_normal)
        .read(gbuffer.motion)
        .write(rays.radiance)
        .write(rays.direction);
    bind_environment(pass, gbuffer);
    parameters.tracers.run(graph, pass, {"tracer"}, hierarchies, probe, 1,
                           [&](PassGraph::Pass& tracing) { draw_masked(tracing, mask.traced); });
    return rays;
}

DiligentResolved diligent_reconstruct(PassGraph& graph, const GBuffer& gbuffer, const DiligentRays& rays,
                                      const DiligentMask& mask, const DiligentFilterParameters& parameters) {
    const bool is_float = parameters.float_histories, is_cleared = parameters.clear_targets;
    const auto target = [&](const char* name, Format format) {
        return diligent_target(graph, name, format, mask.full.extent, is_cleared);
    };
    const DiligentResolved resolved{
        .radiance = target("resolved_radiance", is_float ? Format::rgba32f : Format::rgba16f),
        .variance = target("resolved_variance", is_float ? Format::r32f : Format::r16f),
        .hit_depth = target("hit_depth", parameters.linear_hit_depth ? Format::r32f : Format::r16f)};
    auto pass = graph.fragment("diligent_ssr/spatial_reconstruction.frag");
    pass.read(gbuffer.depth)
        .read(gbuffer.normal)
        .read(mask.roughness)
        .read(rays.radiance)
        .read(rays.direction)
        .write(resolved.radiance)
        .write(resolved.variance)
        .write(resolved.hit_depth);
    draw_masked(pass, mask.full);
    return resolved;
}

DiligentHistories diligent_histories(PassGraph& graph, const DiligentFilterParameters& parameters) {
    const bool is_float = parameters.float_histories;
    return {.radiance = graph.history("accumulated_radiance", is_float ? Format::rgba32f : Format::rgba16f),
            .variance = graph.history("accumulated_variance", is_float ? Format::r32f : Format::r16f)};
}

void diligent_accumulate(PassGraph& graph, const GBuffer& gbuffer, const Image& reprojected_depth,
                         const DiligentResolved& resolved, const DiligentHistories& histories, const DiligentMask& mask,
                         const DiligentFilterParameters& parameters) {
    if (parameters.clear_targets) {
        graph.clear(histories.radiance.current, {});
        graph.clear(histories.variance.current, {});
    }
    const Sampling between_texels{.is_linear = !parameters.float_histories};
    auto pass = graph.fragment("diligent_ssr/temporal_accumulation.frag");
    pass.read(gbuffer.motion)
        .read(gbuffer.previous_depth)
        .read(reprojected_depth)
        .read(resolved.radiance)
        .read(resolved.variance)
        .read(resolved.hit_depth)
        .read(histories.radiance.previous, between_texels)
        .read(histories.variance.previous, between_texels)
        .write(histories.radiance.current)
        .write(histories.variance.current);
    draw_masked(pass, mask.full);
}

Image diligent_cleanup(PassGraph& graph, const GBuffer& gbuffer, const Image& radiance, const Image& variance,
                       const DiligentMask& mask, const DiligentFilterParameters& parameters) {
    const Format format = parameters.float_histories ? Format::rgba32f : Format::rgba16f;
    const Image reflections = diligent_target(graph, "reflections", format, mask.full.extent, true);
    const auto draw = [&](const char* shader) {
        auto pass = graph.fragment(shader);
        pass.read(gbuffer.depth)
            .read(mask.roughness)
            .read(radiance.as("accumulated_radiance"))
            .read(variance.as("accumulated_variance"));
        return pass;
    };
    if (parameters.bilateral_cleanup && parameters.cleanup.is("guided")) {
        const auto target = [&](const char* name) {
            return diligent_target(graph, name, Format::rgba32f, mask.full.extent, true);
        };
        const Image slope = target("guided_slope"), offset = target("guided_offset");
        auto fit = draw("diligent_ssr/guided_coefficients.frag");
        fit.write(slope).write(offset);
        draw_masked(fit, mask.full);
        auto apply = draw("diligent_ssr/guided_cleanup.frag");
        apply.read(slope).read(offset).write(reflections);
        draw_masked(apply, mask.full);
        return reflections;
    }
    auto pass = draw("diligent_ssr/bilateral_cleanup.frag");
    pass.read(gbuffer.normal).write(reflections);
    draw_masked(pass, mask.full);
    return reflections;
}
