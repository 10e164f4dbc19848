// Morph targets (glTF 2.0, section 3.7.2.2).
#include "core/png.h"
#include "core/scene/animation.h"
#include "core/scene/deform.h"
#include "tests/scene/gltf_fixture.h"

namespace {

/// Node 0 draws a square whose first target lifts it along z and whose second stretches it along x and turns normals.
struct Morphs : Gltf {
    nlohmann::json square;

    void SetUp() override {
        Gltf::SetUp();
        square = writer.quad();
        square["targets"] = {{{"POSITION", writer.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}},
                             {{"POSITION", writer.floats({0, 0, 0, 4, 0, 0, 4, 0, 0, 0, 0, 0}, "VEC3")},
                              {"NORMAL", writer.floats({0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0}, "VEC3")}}};
        writer.add_mesh_node(square);
    }
    std::vector<Vertex> posed(const Scene& scene, float frame = 0) {
        const ScenePose pose = pose_scene(scene, frame);
        std::vector<Vertex> storage;
        const std::span<const Vertex> span = posed_vertices(scene, pose, 0, storage);
        return {span.begin(), span.end()};
    }
    void animate(const std::string& interpolation, const std::vector<float>& times, const std::vector<float>& weights) {
        writer.json["animations"] = {
            {{"samplers",
              {{{"input", writer.floats(times, "SCALAR")},
                {"output", writer.floats(weights, "SCALAR")},
                {"interpolation", interpolation}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
    }
};

}  // namespace

TEST_F(Morphs, WeightsAreTheNodesElseTheMeshesElseZero) {
    const auto third_corner = [&] { return posed(load())[2]; };
    expect_near(third_corner().position, {1, 1, 0}, 0);
    writer.json["meshes"][0]["weights"] = {0.5, 0.25};
    EXPECT_TRUE(load().warnings.empty());
    expect_near(third_corner().position, {2, 1, 0.5f}, 1e-6f);
    expect_near(third_corner().normal, glm::normalize(glm::vec3(0, 0.5f, 1)), 1e-6f);
    writer.json["nodes"][0]["weights"] = {-1, 2};
    expect_near(third_corner().position, {9, 1, -1}, 1e-6f);
    expect_near(third_corner().normal, glm::normalize(glm::vec3(0, 4, 1)), 1e-6f);
}

TEST_F(Morphs, ScenesWithoutWeightsAndSkinsCostAndChangeNothing) {
    writer.json["meshes"][0]["primitives"][0].erase("targets");
    const Scene scene = load();
    EXPECT_TRUE(pose_scene(scene, 0).deformations.empty());
    std::vector<Vertex> storage;
    EXPECT_EQ(posed_vertices(scene, pose_scene(scene, 0), 0, storage).data(), scene.meshes[0].vertices.data());
    EXPECT_EQ(storage.capacity(), 0u);
}

TEST_F(Morphs, AnimatedWeightsAreInterpolatedEachByItself) {
    writer.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // sheared: has no parts
    animate("LINEAR", {0, 1}, {0, 1, 2, 0});
    Scene scene = load();
    EXPECT_EQ(scene.frame_count, 31u);
    expect_near(posed(scene, 7.5f)[2].position, {1 + 4 * 0.75f, 1, 0.5f}, 1e-5f);
    EXPECT_EQ(pose_scene(scene, 7).world_from_instance[0][1][0], 0.5f) << "weights leave the matrix";
    animate("STEP", {0, 1}, {0, 1, 2, 0});
    expect_near(posed(load(), 29)[2].position, {5, 1, 0}, 1e-5f);
    expect_near(posed(load(), 30)[2].position, {1, 1, 2}, 1e-5f);
    // In-tangents, values and out-tangents of a key, each of all targets: t^2 with its slopes, and 1 - t, as a cubic.
    animate("CUBICSPLINE", {0, 1}, {0, -1, 0, 1, 0, -1, 2, -1, 1, 0, 2, -1});
    expect_near(posed(load(), 15)[2].position, {1 + 4 * 0.5f, 1, 0.25f}, 1e-5f);
    animate("LINEAR", {0, 1}, {0, 1, 2});
    EXPECT_NE(error_message([&] { load(); }).find("has 2 keys and 3 values of 2 morph targets"), std::string::npos);
}

TEST_F(Morphs, NormalsOfWhatHasNoneAreThoseOfTheMorphedTriangles) {
    square["attributes"].erase("NORMAL");
    square["targets"] = {{{"POSITION", writer.floats({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC3")}}};
    writer.json["meshes"][0] = {{"primitives", {square}}, {"weights", {2}}};
    const Scene scene = load();
    const std::vector<Vertex> vertices = posed(scene);
    ASSERT_EQ(vertices.size(), 6u);
    for (size_t corner = 0; corner < 6; ++corner) {
        const glm::vec3 normal = corner < 3 ? glm::vec3(0, -2, 1) : glm::vec3(-2, 0, 1);  // z = 2 y, and z = 2 x
        expect_near(vertices[scene.meshes[0].indices[corner]].normal, glm::normalize(normal), 1e-6f);
    }
}

TEST_F(Morphs, TangentsFollowWhetherTheFileHasThemOrNot) {
    HostImage image({1, 1}, 3);
    image.values = {0.2f, 0.2f, 1};
    write_png(folder / "bumps.png", image);
    writer.json["images"] = {{{"uri", "bumps.png"}}};
    writer.json["textures"] = {{{"source", 0}}};
    writer.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    square["material"] = 0;
    // Each corner moves to the next one, so that u, along x at first, runs along y.
    square["targets"] = {{{"POSITION", writer.floats({1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0}, "VEC3")}}};
    for (const bool has_tangents : {false, true}) {
        if (has_tangents) {
            square["attributes"]["TANGENT"] = writer.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
            square["targets"][0]["TANGENT"] = writer.floats({-1, 1, 0, -1, 1, 0, -1, 1, 0, -1, 1, 0}, "VEC3");
        }
        for (const float weight : {0.0f, 1.0f}) {
            writer.json["meshes"][0] = {{"primitives", {square}}, {"weights", {weight}}};
            for (const Vertex& vertex : posed(load())) {
                expect_near(glm::vec3(vertex.tangent), {1 - weight, weight, 0}, 1e-6f);
                EXPECT_EQ(vertex.tangent.w, 1.0f);
            }
        }
    }
    // A normal that leans along x leaves of the tangent what is perpendicular to it.
    square["targets"] = {{{"NORMAL", writer.floats({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3")}}};
    writer.json["meshes"][0] = {{"primitives", {square}}, {"weights", {1}}};
    for (const Vertex& vertex : posed(load()))
        expect_near(glm::vec3(vertex.tangent), glm::normalize(glm::vec3(1, 0, -1)), 1e-6f);
}

TEST_F(Morphs, DeltasAreSparseAndOfIntegers) {
    const std::vector<uint16_t> places = {2};
    const std::vector<float> lifted = {0, 0, 3};
    writer.json["accessors"].push_back(
        {{"componentType", 5126},
         {"type", "VEC3"},
         {"count", 4},
         {"sparse",
          {{"count", 1},
           {"indices", {{"bufferView", writer.view(places.data(), 2)}, {"componentType", 5123}}},
           {"values", {{"bufferView", writer.view(lifted.data(), 12)}}}}}});
    const std::vector<int8_t> codes = {0,    0, 0, 0, 127, 0, 0, 0,
                                       -127, 0, 0, 0, 0,   0, 0, 0};  // KHR_mesh_quantization: padded to 4
    writer.json["accessors"].push_back({{"bufferView", writer.view(codes.data(), codes.size())},
                                        {"componentType", 5120},
                                        {"type", "VEC3"},
                                        {"count", 4},
                                        {"normalized", true}});
    writer.json["bufferViews"].back()["byteStride"] = 4;
    writer.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    const int count = int(writer.json["accessors"].size());
    square["targets"] = {{{"POSITION", count - 2}}, {{"POSITION", count - 1}}};
    writer.json["meshes"][0] = {{"primitives", {square}}, {"weights", {1, 0.5}}};
    const std::vector<Vertex> vertices = posed(load());
    expect_near(vertices[0].position, {0, 0, 0}, 0);
    expect_near(vertices[1].position, {1.5f, 0, 0}, 1e-6f);
    expect_near(vertices[2].position, {0.5f, 1, 3}, 1e-6f);
}

TEST_F(Morphs, ComeBeforeJoints) {
    square["attributes"]["JOINTS_0"] = writer.bytes_of_4(std::vector<uint8_t>(16, 0));
    square["attributes"]["WEIGHTS_0"] = writer.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    writer.json["meshes"][0] = {{"primitives", {square}}, {"weights", {1, 0}}};
    writer.json["nodes"][0]["skin"] = 0;
    writer.json["nodes"].push_back({{"scale", {1, 1, 10}}, {"translation", {0, 0, 5}}});
    writer.json["scenes"][0]["nodes"] = {0, 1};
    writer.json["skins"] = {{{"joints", {1}}}};
    expect_near(posed(load())[2].position, {1, 1, 15}, 1e-6f);
}

TEST_F(Morphs, WhatDoesNotFitIsRefusedAndWhatStandsStillSaid) {
    square["targets"][0]["TEXCOORD_0"] = writer.floats({0, 0, 0, 0, 0, 0, 0, 0}, "VEC2");
    writer.json["meshes"][0] = {{"primitives", {square}}};
    EXPECT_TRUE(
        mentions(load().warnings, "The morph targets of mesh '' also move TEXCOORD_0, which ssrlab does not move."));
    const auto said = [&] { return error_message([&] { load(); }); };
    writer.json["nodes"][0]["weights"] = {1};
    EXPECT_NE(said().find("node 0 (''): weights has 1 numbers, but the mesh has 2 morph targets"), std::string::npos)
        << said();
    writer.json["nodes"][0].erase("weights");
    writer.json["meshes"][0]["primitives"].push_back(writer.quad());
    EXPECT_NE(said().find("has primitives with 2 and with 0 morph targets"), std::string::npos) << said();
    square["targets"][0]["POSITION"] = writer.floats({0, 0, 0}, "VEC3");
    writer.json["meshes"][0] = {{"primitives", {square}}};
    EXPECT_NE(said().find("mesh 0 primitive 0 target 0 POSITION has 1 elements for 4 vertices"), std::string::npos)
        << said();
    square["targets"][0]["POSITION"] = writer.floats({0, 0, 9e8f, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
    writer.json["meshes"][0] = {{"primitives", {square}}, {"weights", {2, 0}}};
    const Scene scene = load();
    EXPECT_NE(error_message([&] { posed(scene); }).find("move vertices of mesh '' (node '') beyond +-1e+09 m"),
              std::string::npos);
}
