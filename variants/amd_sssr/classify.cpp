#include "variants/amd_sssr/passes.h"

#include <cmath>

float amd_alpha_of_8_bits(float alpha) { return std::floor(alpha * 255.0f + 0.5f) / 255.0f; }  // as lists.glsl

AmdWork amd_classify(PassGraph& graph, const GBuffer& gbuffer, const AmdHistories& histories, const Image& confidence) {
    const glm::uvec2 extent = graph.extent(), tiles = (extent + 7u) / 8u;
    const AmdWork work{.ray_list = graph.buffer("ray_list", size_t(extent.x) * extent.y * 4),
                       .tile_list = graph.buffer("tile_list", size_t(tiles.x) * tiles.y * 4),
                       .counters = graph.buffer("counters", 16),
                       .indirect_arguments = graph.buffer("indirect_arguments", 36)};
    graph.compute("amd_sssr/classify.comp")
        .read(gbuffer.fallback)
        .read(histories.variance.previous)
        .write(histories.radiance.current)
        .write(histories.roughness.current)
        .write(confidence)
        .use(work.ray_list)
        .use(work.tile_list)
        .use(work.counters)
        .dispatch_groups({tiles, 1});
    return work;
}

void amd_prepare_arguments(PassGraph& graph, const AmdWork& work) {
    graph.compute("amd_sssr/prepare_arguments.comp")
        .use(work.counters)
        .use(work.indirect_arguments)
        .dispatch_groups({1, 1, 1});
}
