#pragma once
#include "core/error.h"
#include "core/scene/gltf/load_gltf.h"
#include "core/scene/load_scene.h"
#include "tests/error_message.h"
#include "tests/scene/gltf_writer.h"

#include <gtest/gtest.h>
#include <algorithm>

namespace fs = std::filesystem;

struct Gltf : testing::Test {
    fs::path folder = fs::temp_directory_path() / "gltf_test";
    GltfWriter writer;

    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    /// The mesh of a file with the one primitive.
    Mesh load_mesh(const nlohmann::json& primitive) {
        writer.add_mesh_node(primitive);
        return load().meshes.at(0);
    }
    Scene load() { return load_gltf(writer.write_glb(folder / "a.glb")); }
};

inline bool mentions(const std::vector<SceneWarning>& warnings, const std::string& text) {
    return std::ranges::any_of(warnings, [&](const SceneWarning& w) { return w.text.find(text) != std::string::npos; });
}

inline void expect_near(glm::vec3 a, glm::vec3 b, float tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}
