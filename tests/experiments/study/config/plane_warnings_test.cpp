// What users hear of a camera's planes before anything is rendered.
#include "experiments/study/config/shots/shot.h"
#include "tests/scene/gltf_writer.h"

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

/// Squares of 2 x 2 km across the view at these depths, before a glTF camera at the origin.
fs::path squares(const fs::path& file, const std::vector<float>& depths, double near, double far) {
    GltfWriter writer;
    writer.json["scenes"] = {{{"nodes", nlohmann::json::array()}}};
    for (const float depth : depths) {
        writer.add_mesh_node(writer.quad());
        nlohmann::json& node = writer.json["nodes"].back();
        node["translation"] = {-1000, -1000, -depth}, node["scale"] = {2000, 2000, 1};
    }
    writer.json["nodes"].push_back({{"camera", 0}});
    for (size_t i = 0; i < writer.json["nodes"].size(); ++i) writer.json["scenes"][0]["nodes"].push_back(i);
    writer.json["cameras"] = {
        {{"name", "main"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", near}, {"zfar", far}}}}};
    return writer.write_gltf(file);
}

std::string warnings_of(const ShotConfig& config) {
    std::string all;
    for (const SceneWarning& warning : load_shot(config, {}).scene.warnings) all += warning.text + "\n";
    return all;
}

struct plane_warnings : testing::Test {
    fs::path folder = fs::temp_directory_path() / "plane_warnings_test";

    void SetUp() override { fs::remove_all(folder), fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
};

}  // namespace

TEST_F(plane_warnings, count_the_pixels_in_which_planes_cut) {
    ShotConfig config{.scene = squares(folder / "a.gltf", {1, 3, 10}, 2, 4), .extent = {64, 36}};
    const std::string cut = warnings_of(config);
    EXPECT_NE(cut.find("camera 'main' (near 2 m, far 4 m) cut surfaces in 2304 of 2304 pixels of frame 0: 2304 before "
                       "near, 0 beyond far"),
              std::string::npos)
        << cut;
    config.has_planes_of_scene = true;
    EXPECT_EQ(warnings_of(config), "");
    const SceneCamera camera = load_shot(config, {}).camera;
    EXPECT_LT(camera.near, 1);
    EXPECT_GT(camera.far, 10);
    config = {.scene = squares(folder / "b.gltf", {1}, 0.5, 4), .extent = {64, 36}};
    EXPECT_EQ(warnings_of(config), "");
    config.scene = squares(folder / "c.gltf", {5}, 0.5, 4);
    EXPECT_NE(warnings_of(config).find("0 before near, 2304 beyond far"), std::string::npos);
    // What hides what planes would cut is as far as the camera sees.
    config.scene = squares(folder / "d.gltf", {3, 10}, 2, 4);
    EXPECT_EQ(warnings_of(config), "");
}

/// Float32 below 1 has steps of 2^-24: 2^-24 300^2 / 0.0001 = 53.6 m.
TEST_F(plane_warnings, say_where_planes_leave_no_precision) {
    ShotConfig config{.scene = squares(folder / "a.gltf", {300}, 1e-4, 1e10), .extent = {64, 36}};
    const std::string said = warnings_of(config);
    EXPECT_NE(said.find("camera 'main' (near 0.0001 m, far 1e+10 m) leave depth in d32f steps of 53.6 m at 300 m"),
              std::string::npos)
        << said;
    for (const char* remedy : {"--reversed-depth", "\"depth_direction\": \"reversed\"", "\"planes\": \"scene\""})
        EXPECT_NE(said.find(remedy), std::string::npos) << remedy;
    config.depth_direction = DepthDirection::reversed;
    EXPECT_EQ(warnings_of(config), "");
    config = {.scene = config.scene, .has_planes_of_scene = true, .extent = {64, 36}};
    EXPECT_EQ(warnings_of(config), "");
    config = {.scene = squares(folder / "b.gltf", {300}, 0.1, 1000), .extent = {64, 36}};
    EXPECT_EQ(warnings_of(config), "");
    config.depth_format = DepthFormat::d16;  // 300^2 / 0.1 / 65535 = 13.7 m
    EXPECT_NE(warnings_of(config).find("d16 steps of 13.7 m"), std::string::npos);
    EXPECT_EQ(warnings_of(config).find("--reversed-depth"), std::string::npos);
}
