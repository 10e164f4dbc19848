#include "variants/none/none.h"

Reflections None::render(PassGraph& graph, const GBuffer&) {
    const Image radiance = graph.image("radiance", Format::rgba32f), confidence = graph.image("confidence", Format::r8);
    graph.clear(radiance, {});
    graph.clear(confidence, {});
    return {radiance, confidence};
}
