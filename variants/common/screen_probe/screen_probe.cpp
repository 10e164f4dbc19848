#include "variants/common/screen_probe/screen_probe.h"

#include "core/gbuffer/gbuffer.h"
#include "variants/common/screen_probe/width.h"

ScreenProbe screen_probe(PassGraph& graph, const GBuffer& gbuffer) {
    const glm::uvec2 inside(screen_probe_width), extent = inside + 2u;
    const PassGraph::History seen = graph.history("probe_seen", Format::rgba32f, inside),
                             facts = graph.history("probe_facts", Format::rg32f, inside);
    const ScreenProbe probe{graph.image_of("screen_probe", Format::rgba32f, extent),
                            graph.image_of("screen_probe_nearness", Format::r32f, extent)};
    graph.compute("common/screen_probe/gather.comp")
        .read(gbuffer.lit.as("lit"))
        .read(seen.previous)
        .read(facts.previous)
        .write(seen.current)
        .write(facts.current)
        .run();
    graph.compute("common/screen_probe/spread.comp")
        .read_linear(seen.current.as("probe_seen"))
        .read_linear(facts.current.as("probe_facts"))
        .write(probe.surfaces)
        .write(probe.nearness)
        .run();
    return probe;
}

std::vector<std::string> screen_probe_stages() { return {"common/screen_probe/gather", "common/screen_probe/spread"}; }
