#include "experiments/study/measuring/rehearsal.h"

#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "core/in_flight.h"
#include "experiments/study/measuring/render_technique.h"
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

void rehearse(Device& device, const std::vector<PointConfig>& techniques) {
    const HostGBuffer host = empty_gbuffer({16, 16});
    RayProbe probe;
    probe.exact_hits = [](const RecordedRays& recorded) { return std::vector<ExactHit>(recorded.rays.size()); };
    probe.answers = [](const RecordedRays& marched, const AskedRays&) {
        return std::vector<ExactHit>(marched.rays.size());
    };
    std::set<std::string> done;
    for (const PointConfig& config : techniques) {
        if (config.external || !done.insert(config.technique + config.preset + config.parameters.dump()).second)
            continue;
        const InFlightText technique_at_work(in_flight().technique, config.technique),
            point_at_work(in_flight().point, config.point);
        PassList pass_list(device, host.extent());
        const std::unique_ptr<Technique> technique = make_technique(config.technique, config.parameters, config.preset);
        technique->ray_probe = &probe;
        render_technique(pass_list, *technique, host.camera, 0, upload_gbuffer(pass_list, host));
        pass_list.times();  // waits, so that the images outlive the work
    }
}
