#include "core/scene/animation.h"
#include "tests/scene/gltf_fixture.h"

#include <cmath>

namespace {
using Property = AnimationChannel::Property;
const float half = std::sqrt(0.5f);
}  // namespace

TEST(Animation, StepsHoldUntilTheNextKey) {
    const AnimationChannel channel{
        .interpolation = Interpolation::step, .times = {1, 2}, .values = {{1, 0, 0, 0}, {5, 0, 0, 0}}};
    EXPECT_EQ(sample_channel(channel, 0.0f).x, 1.0f);
    EXPECT_EQ(sample_channel(channel, 1.999f).x, 1.0f);
    EXPECT_EQ(sample_channel(channel, 2.0f).x, 5.0f);
    EXPECT_EQ(sample_channel(channel, 9.0f).x, 5.0f);
}

TEST(Animation, CubicSplinesAreHermite) {
    // Keys of x = t^3 at t = 1 and 3 with its slopes 3 t^2: a cubic is its own Hermite interpolant.
    AnimationChannel channel{.interpolation = Interpolation::cubic_spline, .times = {1, 3}};
    for (const float t : {1.0f, 3.0f})
        for (const float x : {3 * t * t, t * t * t, 3 * t * t}) channel.values.emplace_back(x, 0, 0, 0);
    for (const float t : {1.0f, 1.5f, 2.0f, 2.9f, 3.0f})
        EXPECT_NEAR(sample_channel(channel, t).x, t * t * t, 1e-5f * 27);
}

TEST(Animation, RotationsTurnAtConstantSpeedTheShortWay) {
    // From 0 to 90 degrees about z, the second key written with the opposite sign, which is the same rotation.
    const AnimationChannel channel{
        .property = Property::rotation, .times = {0, 1}, .values = {{0, 0, 0, 1}, {0, 0, -half, -half}}};
    const glm::vec4 third = sample_channel(channel, 1.0f / 3.0f);  // 30 degrees
    const float angle = glm::radians(15.0f), sign = third.w < 0 ? -1.0f : 1.0f;
    EXPECT_NEAR(sign * third.z, std::sin(angle), 1e-6f);
    EXPECT_NEAR(sign * third.w, std::cos(angle), 1e-6f);
}

using AnimatedGltf = Gltf;

TEST_F(AnimatedGltf, ReplacesOnlyWhatTheChannelNames) {
    writer.add_mesh_node(writer.quad());
    writer.json["nodes"][0].update({{"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}});
    const int times = writer.floats({0, 2}, "SCALAR"), values = writer.floats({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
    writer.json["animations"] = {{{"samplers", {{{"input", times}, {"output", values}}}},
                                  {"channels",
                                   {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}},
                                    {{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
    Scene scene = load();
    EXPECT_TRUE(scene.warnings.empty()) << "there are no morph targets whose weights could change anything";
    EXPECT_EQ(scene.frame_count, 61u);                                         // 2 s at 30 frames per second, both ends
    const glm::mat4 middle = pose_scene(scene, 30).world_from_instance.at(0);  // 90 degrees of 180
    expect_near(middle * glm::vec4(1, 0, 0, 1), {1, 4, 3}, 1e-5f);
}

TEST_F(AnimatedGltf, KeysThatDoNotAscendAreErrors) {
    writer.add_mesh_node(writer.quad());
    const int times = writer.floats({1, 1}, "SCALAR"), values = writer.floats({0, 0, 0, 1, 1, 1}, "VEC3");
    writer.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", values}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    EXPECT_NE(error_message([&] { load(); }).find("do not ascend"), std::string::npos);
    writer.json["animations"][0]["samplers"][0]["input"] = writer.floats({0, 1, 2}, "SCALAR");
    EXPECT_NE(error_message([&] { load(); }).find("3 keys and 2 values"), std::string::npos);
}

TEST_F(AnimatedGltf, LightsAndCamerasFollowTheirNodes) {
    writer.json["nodes"] = {
        {{"children", {1, 2}}, {"translation", {0, 3, 0}}, {"scale", {4, 4, 4}}},
        {{"rotation", {-half, 0, 0, half}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
        {{"camera", 0}, {"scale", {-1, 1, 1}}}};
    writer.json["extensionsUsed"] = {"KHR_lights_punctual"};
    writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"color", {1, 0.5, 0.25}},
         {"intensity", 8},
         {"range", 7},
         {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}}};
    writer.json["cameras"] = {
        {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.5}}}}};
    const fs::path file = writer.write_glb(folder / "a.glb");
    const Scene scene = load_scene(file.string(), {});
    EXPECT_TRUE(scene.warnings.empty());
    const PunctualLight light = pose_scene(scene, 0).lights.at(0);
    EXPECT_EQ(light.type, LightType::spot);
    expect_near(light.intensity, {8, 4, 2}, 0);
    expect_near(light.position, {0, 3, 0}, 0);
    expect_near(light.direction, {0, -1, 0}, 1e-6f);  // -z turned by -90 degrees about x
    EXPECT_EQ(light.range, 7.0f);                     // the parent's scale does not touch it
    EXPECT_NEAR(light.outer_cone_cos, std::cos(0.5f), 1e-6f);
    EXPECT_EQ(scene.camera("eye").vertical_fov, 0.8f);
    EXPECT_GT(scene.camera("eye").far, scene.camera("eye").near);  // the file gives no zfar
}
