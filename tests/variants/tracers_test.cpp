// Any tracer in any technique.
#include "variants/tracers/tracers.h"
#include "tests/variants/amd_scenes.h"
#include "tests/variants/technique_fixture.h"
#include "variants/tracers/outcome.h"

namespace {

struct TracersTest : TechniqueTest {
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = {67, 45}};

    struct Rendered {
        HostImage radiance;
        std::vector<float> confidence;
    };
    Rendered render(Technique& technique) {
        PassList pass_list(device(), view.extent);
        const CameraData camera = camera_data(pose, nullptr, view);
        const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, glossy_floor);
        pass_list.begin_frame(camera, technique.params, gbuffer.images());
        const LimitScope limits(pass_list, technique.ray_probe ? Limits::none : technique.limits);
        const Reflections reflections = technique.render(pass_list, gbuffer);
        const HostImage confidence = pass_list.download(reflections.confidence);
        Rendered rendered{.radiance = pass_list.download(reflections.radiance), .confidence = {}};
        for (size_t i = 0; i < confidence.pixel_count(); ++i)
            rendered.confidence.push_back(confidence.values[i * confidence.channels + reflections.confidence_channel]);
        return rendered;
    }
};

/// What the composite takes for granted: it multiplies, so radiance must be finite where confidence is 0, too.
void expect_valid(const auto& rendered) {
    size_t bad_radiance = 0, bad_confidence = 0;
    for (size_t i = 0; i < rendered.radiance.pixel_count(); ++i) {
        const glm::vec3 radiance = rendered.radiance.rgb(i);
        for (int c = 0; c < 3; ++c) bad_radiance += !(std::isfinite(radiance[c]) && radiance[c] >= 0);
        bad_confidence += !(rendered.confidence[i] >= 0 && rendered.confidence[i] <= 1);
    }
    EXPECT_EQ(bad_radiance, 0u) << "channels that are not finite, or negative";
    EXPECT_EQ(bad_confidence, 0u) << "pixels whose confidence is not within [0, 1]";
}

/// Parameters of a technique that choose among tracers, all set to one; and those that make runs repeat and short.
nlohmann::json all_by(const TracerEntry& tracer, const TechniqueEntry& entry) {
    nlohmann::json parameters = {{"hierarchy.min_traversal_occupancy", 0}};
    const std::unique_ptr<Technique> technique = entry.create();
    for (const Parameter& p : technique->params)
        if (std::ranges::count(p.choices, tracer.name)) parameters[p.name] = tracer.name;
    parameters["fixed_stride.refine"] = true;  // steps of the four-mode pass as printed end too far behind the wall
    parameters["exact_layer.thickness_from"] = "parameter";  // the made-up G-buffer has one layer
    if (entry.name == "amd_sssr") parameters["denoise"] = false;
    if (entry.name == "frostbite_sssr") parameters["max_rays"] = parameters["min_rays"] = 4;  // probes have one
    if (entry.name == "composed_ssr") parameters["half_resolution"] = false;
    return parameters;
}

}  // namespace

TEST_F(TracersTest, TraceForEveryTechniqueAndChangeNothingWhenRecorded) {
    for (const TechniqueEntry& entry : technique_table())
        for (const TracerEntry& tracer : tracer_table()) {
            if (entry.name == "none" || tracer.name == "exact_scene") continue;  // there is no scene to ask
            SCOPED_TRACE(entry.name + ", " + tracer.name);
            const std::unique_ptr<Technique> probed = make_technique(entry.name, all_by(tracer, entry));
            RayProbe probe;
            probe.is_recording = true;
            probed->ray_probe = &probe;
            const Rendered result = render(*probed);
            expect_valid(result);
            // Each technique's recording and each tracer's is compared once, as their shaders are compiled anew for it.
            if (entry.name == "mcguire_dda" || &tracer == &tracer_table().front()) {
                const std::unique_ptr<Technique> plain = make_technique(entry.name, all_by(tracer, entry));
                EXPECT_TRUE(render(*plain).radiance.values == result.radiance.values);
            }
            EXPECT_FALSE(probe.recorded.empty());
            size_t hits = 0, rays = 0;
            for (const RecordedRays& recorded : probe.recorded) {
                ASSERT_EQ(recorded.rays.size(), view.extent.x * view.extent.y * recorded.rays_per_pixel);
                for (const RayRecord& ray : recorded.rays) {
                    if (ray.is_traced == 0) continue;
                    ++rays;
                    hits += ray.outcome == outcome_hit;
                    ASSERT_LT(ray.outcome, outcome_count);
                    ASSERT_EQ(ray.confidence > 0, ray.outcome == outcome_hit);
                    ASSERT_NEAR(glm::length(ray.direction), 1, 1e-4);
                }
            }
            EXPECT_GT(rays, 400u);
            EXPECT_GT(double(hits), 0.2 * double(rays));
        }
}
