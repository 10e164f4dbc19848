// Histories in 16 and in 32 bits, in every technique that has one.
#include "tests/variants/mirror_scenes.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>

namespace {

struct HistoryFormat : TechniqueTest {
    /// What a mirror shows of a wall of the radiance 1/3, which no half is, after some frames at rest.
    HostImage shown(const std::string& name, nlohmann::json parameters, bool is_float) {
        constexpr glm::uvec2 extent{64, 48};
        const CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
        parameters["float_histories"] = is_float;
        const auto technique = make_technique(name, parameters);
        PassList pass_list(device(), extent);
        const SyntheticScene scene = [](const CameraRay& ray) {
            SyntheticHit hit = floor_before_white(ray);
            hit.lit /= 3.0f;
            return hit;
        };
        HostImage found;
        for (unsigned frame = 0; frame < frames; ++frame) {
            const CameraData camera =
                camera_data(pose, frame > 0 ? &pose : nullptr, {.extent = extent, .frame = frame});
            const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
            pass_list.upload(gbuffer.motion, motion_of(pose, camera, scene));
            pass_list.begin_frame(camera, technique->params, gbuffer.images());
            found = pass_list.download(technique->render(pass_list, gbuffer).radiance);
        }
        return found;
    }
    static constexpr unsigned frames = 4;
};

}  // namespace

TEST_F(HistoryFormat, HalvesRoundAndChangeNothingElse) {
    const std::map<std::string, nlohmann::json> averaging = {
        {"amd_sssr", {{"hierarchy.min_traversal_occupancy", 0}}},
        {"diligent_ssr", {{"temporal_radiance_stability_factor", 0.9}}},
        {"frostbite_sssr", nlohmann::json::object()},
        {"four_mode_ssr", {{"mode", "temporal"}}}};
    for (const auto& [name, parameters] : averaging) {
        SCOPED_TRACE(name);
        const HostImage halves = shown(name, parameters, false), floats = shown(name, parameters, true);
        size_t rounded = 0, lit = 0;
        for (size_t i = 0; i < floats.pixel_count(); ++i) {
            const float expected = floats.values[4 * i];
            lit += expected > 0.1f;
            rounded += halves.values[4 * i] != expected;
            // Each frame stores a history some three times, each time with up to 2^-10 of it lost; confidences are
            // stored, too, and colours divided by them.
            EXPECT_NEAR(halves.values[4 * i], expected, 8 * frames * 0x1p-10f * std::max(expected, 0.01f)) << i;
        }
        EXPECT_GT(lit, 100u);
        EXPECT_GT(rounded, lit / 2);
    }
}
