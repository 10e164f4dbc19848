#include "tests/variants/frostbite_passes.h"

#include <cstring>

namespace {

template <class T>
std::vector<T> read(PassList& pass_list, const Buffer& buffer) {
    const std::vector<std::byte> bytes = pass_list.download(buffer);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

std::vector<uint32_t> read_list(PassList& pass_list, const Buffer& list, uint32_t count) {
    std::vector<uint32_t> values = read<uint32_t>(pass_list, list);
    EXPECT_LE(count, values.size());
    values.resize(std::min(size_t(count), values.size()));
    return values;
}

}  // namespace

FrostbiteParameters::FrostbiteParameters() = default;

FrostbiteTraced trace_frostbite(PassList& pass_list, const GBuffer& gbuffer, const FrostbiteParameters& parameters) {
    const Tracers::Images depths = parameters.ray.tracers.images(pass_list, gbuffer.depth);
    const FrostbiteTiles tiles = frostbite_classify(pass_list, gbuffer, depths, gbuffer.lit, parameters.ray);
    const FrostbiteWork work = frostbite_allocate(pass_list, gbuffer, tiles, parameters.ray);
    const TracedRays rays =
        frostbite_trace(pass_list, depths, work, HorizonImage().on(pass_list, parameters.params), parameters.ray);
    const std::vector<uint32_t> counters = read<uint32_t>(pass_list, work.counters);
    return {.ray_count = pass_list.download(tiles.ray_count),
            .smooth_list = read_list(pass_list, work.smooth_list, counters[0]),
            .rough_list = read_list(pass_list, work.rough_list, counters[1]),
            .arguments = read<uint32_t>(pass_list, work.indirect_arguments),
            .extent = work.extent,
            .directions = read<glm::vec4>(pass_list, rays.directions),
            .hits = read<glm::uvec4>(pass_list, rays.hits)};
}
