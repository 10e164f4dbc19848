// Frostbite's technique from the G-buffer to the image.
#include "tests/variants/amd_scenes.h"
#include "tests/variants/held_camera.h"
#include "tests/variants/other_subgroups.h"

namespace {

struct FrostbiteTechniqueTest : HeldCamera {
    /// Channels: radiance, confidence.
    HostImage render(Technique& technique, const SyntheticScene& scene, unsigned count = 1, float environment = 0) {
        const HostImage found = HeldCamera::render(technique, scene, count, environment).radiance;
        EXPECT_EQ(reflections.confidence.storage, reflections.radiance.storage);
        EXPECT_EQ(reflections.confidence_channel, 3u);
        return found;
    }
    HostImage render(const nlohmann::json& parameters, const std::string& preset, const SyntheticScene& scene,
                     unsigned count = 1, float environment = 0) {
        return render(*make_technique("frostbite_sssr", parameters, preset), scene, count, environment);
    }
    std::vector<std::string> stages() const {
        std::vector<std::string> names;
        for (const PassTime& time : times)
            if (time.stage != "clear") names.push_back(time.stage);
        std::ranges::sort(names);
        return names;
    }
};

std::vector<std::string> presets() {
    std::vector<std::string> names;
    for (const Preset& preset : find_technique("frostbite_sssr").presets) names.push_back(preset.name);
    return names;
}

/// All that is seen radiates 1.
SyntheticHit furnace_floor(const CameraRay& ray) {
    SyntheticHit hit = glossy_floor(ray);
    hit.lit = glm::vec3(1);
    return hit;
}

/// With everything radiating 1, each average, each mip level and each blend is 1, up to rounding. Where rays hit
/// nothing at all there is nothing to see.
TEST_F(FrostbiteTechniqueTest, KeepsAFurnaceAtOne) {
    for (const std::string& preset : presets())
        for (const unsigned frames : {1u, 6u}) {
            SCOPED_TRACE(testing::Message() << preset << ", " << frames << " frames");
            const HostImage image = render({}, preset, furnace_floor, frames, 1.0f);
            unsigned count = 0;
            for (size_t i = 0; i < image.pixel_count(); ++i) {
                const float confidence = image.values[4 * i + 3];
                if (confidence == 0) continue;
                ++count;
                ASSERT_LE(confidence, 1 + 1e-6f);
                for (int c = 0; c < 3; ++c) ASSERT_NEAR(image.values[4 * i + c], 1, 1e-5f) << i;
            }
            EXPECT_GT(count, 5000u);
        }
}

glm::vec2 pixel_from_world(const CameraData& camera, glm::vec3 p) {
    const glm::vec4 clip = camera.clip_from_world * glm::vec4(p, 1);
    return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(camera.extent);
}

/// A mirror keeps, through reuse and history, what it shows: the wall's 0.25 below y = 1 and 1 above. Taps reach 8
/// pixels along the floor, where the wall's image moves as far.
TEST_F(FrostbiteTechniqueTest, KeepsWhatAMirrorShows) {
    for (const std::string& preset : presets()) {
        SCOPED_TRACE(preset);
        const HostImage image = render({}, preset, mirror_floor, 4);
        const CameraData camera = camera_data(pose, nullptr, view);
        unsigned below = 0, above = 0, wrong = 0;
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) {
                const CameraRay ray = camera_ray(pose, view.extent, glm::vec2(x, y) + 0.5f);
                const SyntheticHit first = mirror_floor(ray);
                if (first.metalness == 0) continue;
                const glm::vec3 p = ray.origin + first.distance * ray.direction;
                const glm::vec3 d = ray.direction * glm::vec3(1, -1, 1), met = p + (-6 - p.z) / d.z * d;
                const glm::vec2 pixel = pixel_from_world(camera, met), border(10);
                if (p.z < -5.5f || std::abs(met.y - 1) < 0.6f || glm::any(glm::lessThan(pixel, border)) ||
                    glm::any(glm::greaterThan(pixel, glm::vec2(view.extent) - border)))
                    continue;
                const float* shown = image.pixel(x, y);
                wrong += std::abs(shown[0] * shown[3] - (met.y > 1 ? 1.0f : 0.25f)) > 1e-3f;
                ++(met.y > 1 ? above : below);
            }
        EXPECT_EQ(wrong, 0u);
        EXPECT_GT(below, 300u);
        EXPECT_GT(above, 300u);
    }
}

SyntheticHit rough_floor(const CameraRay& ray) {
    SyntheticHit hit = glossy_floor(ray);
    hit.roughness = 0.7f;
    return hit;
}

TEST_F(FrostbiteTechniqueTest, LeavesEverythingOutWhereNothingIsSmoothEnough) {
    SceneFacts facts{.has_geometry = true,
                     .has_reflective = true,
                     .min_roughness = 0.7f,
                     .max_roughness = 0.7f,
                     .camera_moves = true,
                     .has_environment = true};
    const nlohmann::json all = nlohmann::json::object();
    const nlohmann::json few = {
        {"previous_frame", false}, {"filtered_sampling", false}, {"classification", false}, {"temporal_filter", false}};
    nlohmann::json divided = few;
    divided["reflectance_after_filter"] = false;
    for (const nlohmann::json& parameters : {all, few, divided}) {
        SCOPED_TRACE(parameters.dump());
        const auto whole = make_technique("frostbite_sssr", parameters),
                   less = make_technique("frostbite_sssr", parameters);
        std::vector<std::string> left_out;
        for (const LeftOut& stage : less->leave_out(facts)) left_out.push_back(stage.what);
        const HostImage all_run = render(*whole, rough_floor, 2, 0.5f);
        std::ranges::sort(left_out);
        EXPECT_EQ(left_out, stages());
        const HostImage none_run = render(*less, rough_floor, 2, 0.5f);
        EXPECT_EQ(stages(), std::vector<std::string>());
        EXPECT_EQ(all_run.values, HostImage(view.extent, 4).values);
        EXPECT_EQ(none_run.values, all_run.values);
    }
    facts.min_roughness = 0.6f;
    const std::vector<LeftOut> rough_only = make_technique("frostbite_sssr")->leave_out(facts);
    ASSERT_EQ(rough_only.size(), 1u);
    EXPECT_EQ(rough_only.front().what, "frostbite_sssr/trace_smooth");
    facts.min_roughness = 0.1f;
    EXPECT_TRUE(make_technique("frostbite_sssr")->leave_out(facts).empty());
    facts.has_reflective = false;
    EXPECT_FALSE(make_technique("frostbite_sssr")->leave_out(facts).empty());
}

TEST_F(FrostbiteTechniqueTest, RepeatsItselfUnlessTheSeedDiffers) {
    for (const std::string& preset : presets()) {
        const HostImage first = render({}, preset, glossy_floor, 3), again = render({}, preset, glossy_floor, 3);
        EXPECT_TRUE(first.values == again.values) << preset;
        view.seed = 1;
        EXPECT_FALSE(first.values == render({}, preset, glossy_floor, 3).values) << preset;
        view.seed = 0;
    }
}

struct FrostbiteSubgroups : FrostbiteTechniqueTest {
    LayeredImage image() { return {.layers = {{"", "RGBA", render({}, "best", glossy_floor, 3)}}, .attributes = {}}; }
};

/// Run by the test below, with subgroups of another size.
TEST_F(FrostbiteSubgroups, DISABLED_WriteTheirImage) { write_for_caller(image()); }

TEST_F(FrostbiteSubgroups, OfAnySizeGiveTheSameImage) {
    if (!device().info().is_cpu()) GTEST_SKIP() << "the size of this device's subgroups cannot be chosen";
    const LayeredImage expected = image();
    for (const char* bits : vector_widths) {
        const LayeredImage found = written_with_vectors_of(bits, "FrostbiteSubgroups.DISABLED_*");
        EXPECT_TRUE(found.layers.front().image.values == expected.layers.front().image.values) << bits;
    }
}

}  // namespace
