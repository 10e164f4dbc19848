#include "variants/frostbite_sssr/passes.h"

#include "core/gbuffer/environment_images.h"

#include <algorithm>
#include <bit>

Image frostbite_color_pyramid(PassGraph& graph, const Image& color) {
    const unsigned mips = unsigned(std::bit_width(std::max(color.extent.x, color.extent.y)));
    const Image pyramid = graph.image_of("color_pyramid", Format::rgba32f, color.extent, mips);
    for (unsigned level = 0; level < mips; ++level)
        graph.compute("frostbite_sssr/color_pyramid.comp")
            .read((level == 0 ? color : pyramid.mip(level - 1)).as("finer"))
            .write(pyramid.mip(level).as("coarser"))
            .run();
    return pyramid;
}

FrostbiteTiles frostbite_classify(PassGraph& graph, const GBuffer& gbuffer, const Tracers::Images& images,
                                  const Image& color, const FrostbiteRayParameters& parameters, RayProbe* probe) {
    const glm::uvec2 extent = gbuffer.depth.extent, tiles = (extent + frostbite_tile - 1u) / frostbite_tile;
    const PassGraph::History ray_count = graph.history("ray_count", Format::r32f, tiles);
    if (!parameters.classification) {
        graph.clear(ray_count.current, glm::vec4(float(unsigned(parameters.max_rays))));
        return {ray_count.current};
    }
    const glm::uvec2 blocks = (extent + frostbite_probe_spacing - 1u) / frostbite_probe_spacing;
    const Image probes = graph.image_of("probes", Format::rg32f, blocks);
    PassGraph::Pass pass = graph.compute("frostbite_sssr/probe.comp");
    pass.read(color.as("hit_color")).write(probes).label("frostbite_sssr/classify");
    parameters.tracers.run(graph, pass, {"tracer", "rough_tracer"}, images, probe, 1,
                           [](PassGraph::Pass& probing) { probing.run(); });
    const PassGraph::History frames_left = graph.history("frames_left", Format::r32f, tiles);
    graph.compute("frostbite_sssr/count_rays.comp")
        .read(probes)
        .read(ray_count.previous)
        .read(frames_left.previous)
        .write(ray_count.current)
        .write(frames_left.current)
        .label("frostbite_sssr/classify")
        .run();
    return {ray_count.current};
}

FrostbiteWork frostbite_allocate(PassGraph& graph, const GBuffer& gbuffer, const FrostbiteTiles& tiles,
                                 const FrostbiteRayParameters& parameters) {
    const glm::uvec2 screen = gbuffer.depth.extent, extent = parameters.half_resolution ? (screen + 1u) / 2u : screen;
    const size_t list_bytes = size_t(extent.x) * extent.y * parameters.max_rays * 4;
    const FrostbiteWork work{.smooth_list = graph.buffer("smooth_list", list_bytes),
                             .rough_list = graph.buffer("rough_list", list_bytes),
                             .counters = graph.buffer("counters", 8),
                             .indirect_arguments = graph.buffer("indirect_arguments", 24),
                             .extent = extent};
    graph.clear(work.counters, 0);
    graph.compute("frostbite_sssr/allocate.comp")
        .read(tiles.ray_count)
        .use(work.smooth_list)
        .use(work.rough_list)
        .use(work.counters)
        .run(extent);
    graph.compute("frostbite_sssr/prepare_arguments.comp")
        .use(work.counters)
        .use(work.indirect_arguments)
        .label("frostbite_sssr/allocate")
        .dispatch_groups({1, 1, 1});
    return work;
}

TracedRays frostbite_trace(PassGraph& graph, const Tracers::Images& images, const FrostbiteWork& work,
                           const Image& below_horizon, const FrostbiteRayParameters& parameters, RayProbe* probe) {
    const size_t rays = size_t(work.extent.x) * work.extent.y * parameters.max_rays;
    const TracedRays traced{.directions = graph.buffer("directions", rays * 16),
                            .hits = graph.buffer("hits", rays * 16)};
    graph.clear(traced.directions, 0);  // of rays that no list has
    const auto trace = [&](const char* shader, const char* slot, const Buffer& list, size_t arguments) {
        PassGraph::Pass pass = graph.compute(shader);
        pass.read(below_horizon).use(list).use(work.counters).use(traced.directions).use(traced.hits);
        parameters.tracers.run(graph, pass, {slot}, images, probe, parameters.max_rays,
                               [&](PassGraph::Pass& tracing) { tracing.dispatch(work.indirect_arguments, arguments); });
    };
    if (work.has_smooth) trace("frostbite_sssr/trace_smooth.comp", "tracer", work.smooth_list, 0);
    if (work.has_rough) trace("frostbite_sssr/trace_rough.comp", "rough_tracer", work.rough_list, 12);
    return traced;
}

namespace {

/// Groups of pixels that share rays, see taps.glsl.
glm::uvec2 groups_of(glm::uvec2 extent, const FrostbiteResolveParameters& parameters) {
    if (parameters.taps.is("1") || parameters.pattern.is("rotated")) return extent;
    if (parameters.pattern.is("quad_shared")) return (extent + 1u) / 2u;
    const unsigned farthest_move = 2;
    return (extent + farthest_move + 3u) / 4u * 2u;
}

}  // namespace

FrostbiteResolved frostbite_resolve(PassGraph& graph, const GBuffer& gbuffer, const Image& color,
                                    const Image& split_sum, const Image& below_horizon, const TracedRays& rays,
                                    const FrostbiteResolveParameters& parameters) {
    const glm::uvec2 extent = gbuffer.depth.extent;
    const FrostbiteResolved resolved{graph.image("resolved_radiance", Format::rgba32f),
                                     graph.image("resolved_length", Format::r32f)};
    PassGraph::Pass pass = graph.compute("frostbite_sssr/resolve.comp");
    pass.read_linear(color.as("color_pyramid"))
        .read(split_sum)
        .read(below_horizon)
        .use(rays.directions)
        .use(rays.hits)
        .write(resolved.radiance)
        .write(resolved.reflection_depth);
    bind_environment(pass, gbuffer).run(groups_of(extent, parameters));
    return resolved;
}

Image frostbite_accumulate(PassGraph& graph, const GBuffer& gbuffer, const Image& split_sum,
                           const FrostbiteResolved& resolved, const FrostbiteResolveParameters& parameters) {
    if (!parameters.temporal_filter && parameters.reflectance_after_filter) return resolved.radiance;
    const PassGraph::History accumulated =
        graph.history("accumulated", parameters.float_histories ? Format::rgba32f : Format::rgba16f);
    const Image reflections = graph.image("reflections", Format::rgba32f);
    graph.compute("frostbite_sssr/accumulate.comp")
        .read(gbuffer.motion)
        .read(gbuffer.previous_depth)
        .read(gbuffer.previous_normal)
        .read(split_sum)
        .read(resolved.radiance)
        .read(resolved.reflection_depth)
        .read(accumulated.previous)
        .write(accumulated.current)
        .write(reflections)
        .run();
    return reflections;
}
