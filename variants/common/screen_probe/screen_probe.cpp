#include "variants/common/screen_probe/screen_probe.h"

#include "core/gbuffer/environment_images.h"
#include "core/gbuffer/gbuffer.h"
#include "variants/common/screen_probe/width.h"

ScreenProbe screen_probe(PassList& pass_list, const GBuffer& gbuffer) {
    const glm::uvec2 inside(screen_probe_width), extent = inside + 2u;
    const PassList::History seen = pass_list.history("probe_seen", Format::rgba32f, inside),
                            facts = pass_list.history("probe_facts", Format::rg32f, inside),
                            moments = pass_list.history("probe_moments", Format::rgba32f, {1, 1});
    const ScreenProbe probe{pass_list.image_of("screen_probe", Format::rgba32f, extent),
                            pass_list.image_of("screen_probe_nearness", Format::r32f, extent)};
    const Image lit = pass_list.image_of("probe_lit", Format::rgba32f, inside),
                unoccluded = pass_list.image_of("probe_unoccluded", Format::rgba32f, inside),
                environment = pass_list.image_of("probe_environment", Format::rgba32f, inside);
    PassList::Pass gather = pass_list.compute("common/screen_probe/gather.comp");
    gather.read(gbuffer.lit.as("lit"))
        .read(seen.previous)
        .read(facts.previous)
        .read(moments.previous)
        .write(seen.current)
        .write(facts.current)
        .write(environment)
        .write(lit)
        .write(unoccluded);
    bind_environment(gather, gbuffer).dispatch_groups({inside, 1});  // a group for each texel
    pass_list.compute("common/screen_probe/spread.comp")
        .read_linear(seen.current.as("probe_seen"))
        .read_linear(facts.current.as("probe_facts"))
        .read_linear(lit)
        .read_linear(unoccluded)
        .read_linear(environment)
        .write(probe.surfaces)
        .write(probe.nearness)
        .write(moments.current)
        .dispatch_groups({extent, 1});
    return probe;
}

std::vector<std::string> screen_probe_stages() { return {"common/screen_probe/gather", "common/screen_probe/spread"}; }
