#include "tests/variants/frostbite_passes.h"

#include <cstring>

namespace {

template <class T>
std::vector<T> read(PassGraph& graph, const Buffer& buffer) {
    const std::vector<std::byte> bytes = graph.download(buffer);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

std::vector<uint32_t> read_list(PassGraph& graph, const Buffer& list, uint32_t count) {
    std::vector<uint32_t> values = read<uint32_t>(graph, list);
    EXPECT_LE(count, values.size());
    values.resize(std::min(size_t(count), values.size()));
    return values;
}

}  // namespace

FrostbiteParameters::FrostbiteParameters() = default;

FrostbiteTraced trace_frostbite(PassGraph& graph, const GBuffer& gbuffer, const FrostbiteParameters& parameters) {
    const Tracers::Images depths = parameters.ray.tracers.images(graph, gbuffer.depth);
    const FrostbiteTiles tiles = frostbite_classify(graph, gbuffer, depths, gbuffer.lit, parameters.ray);
    const FrostbiteWork work = frostbite_allocate(graph, gbuffer, tiles, parameters.ray);
    const TracedRays rays =
        frostbite_trace(graph, depths, work, HorizonImage().on(graph, parameters.params), parameters.ray);
    const std::vector<uint32_t> counters = read<uint32_t>(graph, work.counters);
    return {.ray_count = graph.download(tiles.ray_count),
            .smooth_list = read_list(graph, work.smooth_list, counters[0]),
            .rough_list = read_list(graph, work.rough_list, counters[1]),
            .arguments = read<uint32_t>(graph, work.indirect_arguments),
            .extent = work.extent,
            .directions = read<glm::vec4>(graph, rays.directions),
            .hits = read<glm::uvec4>(graph, rays.hits)};
}
