#include "variants/common/screen_probe/screen_probe.h"

#include "core/gbuffer/environment_images.h"
#include "core/gbuffer/gbuffer.h"
#include "variants/common/screen_probe/width.h"

ScreenProbe screen_probe(PassList& pass_list, const GBuffer& gbuffer) {
    const glm::uvec2 inside(screen_probe_width), extent = inside + 2u;
    const PassList::History seen = pass_list.history("probe_seen", Format::rgba32f, inside),
                            facts = pass_list.history("probe_facts", Format::rg32f, inside),
                            environment = pass_list.history("probe_environment", Format::rgba32f, inside);
    const ScreenProbe probe{pass_list.image_of("screen_probe", Format::rgba32f, extent),
                            pass_list.image_of("screen_probe_nearness", Format::r32f, extent)};
    const Image lit = pass_list.image_of("probe_lit", Format::rgba32f, inside),
                unoccluded = pass_list.image_of("probe_unoccluded", Format::rgba32f, inside);
    PassList::Pass gather = pass_list.compute("common/screen_probe/gather.comp");
    gather.read(gbuffer.lit.as("lit"))
        .read(seen.previous)
        .read(facts.previous)
        .read_linear(environment.previous)
        .write(seen.current)
        .write(facts.current)
        .write(environment.current)
        .write(lit)
        .write(unoccluded);
    bind_environment(gather, gbuffer).run();
    pass_list.compute("common/screen_probe/spread.comp")
        .read_linear(seen.current.as("probe_seen"))
        .read_linear(facts.current.as("probe_facts"))
        .read_linear(lit)
        .read_linear(unoccluded)
        .write(probe.surfaces)
        .write(probe.nearness)
        .run();
    return probe;
}

std::vector<std::string> screen_probe_stages() { return {"common/screen_probe/gather", "common/screen_probe/spread"}; }
