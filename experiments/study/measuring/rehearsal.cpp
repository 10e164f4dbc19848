#include "experiments/study/measuring/rehearsal.h"

#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "experiments/study/measuring/render_variant.h"
#include "variants/registry.h"

#include <set>

HostGBuffer empty_gbuffer(glm::uvec2 extent) {
    const auto image = [&](unsigned channels) { return HostImage(extent, channels); };
    HostGBuffer gbuffer{.camera = camera_data(CameraPose{}, nullptr, {.extent = extent}),
                        .depth = HostImage(extent, 1, 1.0f),
                        .geometric_normal = image(4),
                        .normal = image(4),
                        .base_color = image(4),
                        .emission = image(4),
                        .motion = image(2),
                        .material_id = image(1),
                        .previous_depth = HostImage(extent, 1, 1.0f),
                        .previous_normal = image(4),
                        .lit = image(4),
                        .fallback = image(4)};
    gbuffer.second_depth = gbuffer.back_depth = gbuffer.depth;
    return gbuffer;
}

void rehearse(Device& device, const std::vector<VariantConfig>& variants) {
    const HostGBuffer host = empty_gbuffer({16, 16});
    RayProbe probe;
    probe.exact_hits = [](const RecordedRays& recorded) { return std::vector<ExactHit>(recorded.rays.size()); };
    probe.answers = [](const RecordedRays& marched, const AskedRays&) {
        return std::vector<ExactHit>(marched.rays.size());
    };
    std::set<std::string> done;
    for (const VariantConfig& config : variants) {
        if (config.external || !done.insert(config.variant + config.preset + config.parameters.dump()).second) continue;
        PassGraph graph(device, host.extent());
        const std::unique_ptr<Variant> variant = make_variant(config.variant, config.parameters, config.preset);
        variant->ray_probe = &probe;
        render_variant(graph, *variant, host.camera, 0, upload_gbuffer(graph, host));
        graph.times();  // waits, so that the images outlive the work
    }
}
