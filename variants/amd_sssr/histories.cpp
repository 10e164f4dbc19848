#include "variants/amd_sssr/passes.h"

AmdHistories amd_histories(PassGraph& graph, bool is_float, bool is_float_roughness) {
    const Format radiance = is_float ? Format::rgba32f : Format::rgba16f;
    const Format scalar = is_float ? Format::r32f : Format::r16f;
    const Format average = is_float ? Format::rgba32f : Format::r11g11b10f;
    const glm::uvec2 tiles = (graph.extent() + 7u) / 8u;
    return {.radiance = graph.history("radiance", radiance),
            .variance = graph.history("variance", scalar),
            .sample_count = graph.history("sample_count", scalar),
            .average_radiance = graph.history("average_radiance", average, tiles),
            .roughness = graph.history("roughness", is_float_roughness ? Format::r32f : Format::r8)};
}
