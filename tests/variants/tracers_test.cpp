// Any tracer in any technique.
#include "variants/tracers/tracers.h"
#include "tests/variants/amd_scenes.h"
#include "tests/variants/variant_fixture.h"
#include "variants/tracers/outcome.h"

namespace {

struct TracersTest : VariantTest {
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = {67, 45}};

    struct Rendered {
        HostImage radiance;
        std::vector<float> confidence;
    };
    Rendered render(Variant& variant) {
        PassGraph graph(device(), view.extent);
        const CameraData camera = camera_data(pose, nullptr, view);
        const GBuffer gbuffer = upload_gbuffer(graph, pose, camera, glossy_floor);
        graph.begin_frame(camera, variant.params, gbuffer.images());
        const LimitScope limits(graph, variant.ray_probe ? Limits::none : variant.limits);
        const Reflections reflections = variant.render(graph, gbuffer);
        const HostImage confidence = graph.download(reflections.confidence);
        Rendered rendered{.radiance = graph.download(reflections.radiance), .confidence = {}};
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
nlohmann::json all_by(const TracerEntry& tracer, const VariantEntry& entry) {
    nlohmann::json parameters = {{"hierarchy.min_traversal_occupancy", 0}};
    const std::unique_ptr<Variant> variant = entry.create();
    for (const Parameter& p : variant->params)
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
    for (const VariantEntry& entry : variant_table())
        for (const TracerEntry& tracer : tracer_table()) {
            if (entry.name == "none" || tracer.name == "exact_scene") continue;  // there is no scene to ask
            SCOPED_TRACE(entry.name + ", " + tracer.name);
            const std::unique_ptr<Variant> probed = make_variant(entry.name, all_by(tracer, entry));
            RayProbe probe;
            probe.is_recording = true;
            probed->ray_probe = &probe;
            const Rendered result = render(*probed);
            expect_valid(result);
            // Each technique's recording and each tracer's is compared once, as their shaders are compiled anew for it.
            if (entry.name == "mcguire_dda" || &tracer == &tracer_table().front()) {
                const std::unique_ptr<Variant> plain = make_variant(entry.name, all_by(tracer, entry));
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
