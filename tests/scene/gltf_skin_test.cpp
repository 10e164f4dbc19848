// Skins: joints place vertices (glTF 2.0, section 3.7.3).
#include "core/scene/camera_planes.h"
#include "core/scene/deform.h"
#include "core/scene/instance_bounds.h"
#include "core/scene/transform.h"
#include "tests/scene/gltf_fixture.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace {

/// Node 0 draws a square with normals that lean, nodes 1 and 2 are its joints.
struct Skins : Gltf {
    nlohmann::json square;

    void SetUp() override {
        Gltf::SetUp();
        square = writer.quad();
        square["attributes"]["NORMAL"] =
            writer.floats({0.6f, 0, 0.8f, 0, 0.6f, 0.8f, 0.48f, 0.6f, 0.64f, 0, 0, 1}, "VEC3");
        follow({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
        writer.add_mesh_node(square);
        writer.json["nodes"][0].update({{"name", "body"}, {"skin", 0}});
        writer.json["nodes"].push_back({{"name", "hip"}});
        writer.json["nodes"].push_back({{"name", "knee"}});
        writer.json["scenes"][0]["nodes"] = {0, 1, 2};
        writer.json["skins"] = {{{"joints", {1, 2}}}};
    }

    void follow(const std::vector<uint8_t>& joints, const std::vector<float>& weights, const std::string& set = "0") {
        square["attributes"]["JOINTS_" + set] = writer.bytes_of_4(joints);
        square["attributes"]["WEIGHTS_" + set] = writer.floats(weights, "VEC4");
        if (!writer.json["meshes"].empty()) writer.json["meshes"][0]["primitives"] = {square};
    }

    /// World space, with normals and tangents as both renderers make them of pose and instance.
    std::vector<Vertex> posed(const Scene& scene, size_t instance = 0, float frame = 0) {
        const ScenePose pose = pose_scene(scene, frame);
        std::vector<Vertex> storage;
        const std::span<const Vertex> span = posed_vertices(scene, pose, instance, storage);
        std::vector<Vertex> vertices(span.begin(), span.end());
        const glm::mat4& world = pose.world_from_instance[instance];
        const NormalTransform normals = normal_transform(world);
        for (Vertex& v : vertices) {
            v.position = world * glm::vec4(v.position, 1.0f);
            v.normal = glm::normalize(normals.matrix * v.normal);
            v.tangent =
                glm::vec4(glm::mat3(world) * glm::vec3(v.tangent), normals.is_mirrored ? -v.tangent.w : v.tangent.w);
        }
        return vertices;
    }
    /// Tangents follow where a normal map reads them.
    Scene with_normal_map(Scene scene) {
        for (Material& material : scene.materials) material.normal_texture.texture = 0;
        return scene;
    }
    void set_inverse_bind(const std::vector<glm::mat4>& matrices) {
        std::vector<float> values;
        for (const glm::mat4& m : matrices) values.insert(values.end(), glm::value_ptr(m), glm::value_ptr(m) + 16);
        writer.json["skins"][0]["inverseBindMatrices"] = writer.floats(values, "MAT4");
    }
};

const std::vector<glm::vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

}  // namespace

TEST_F(Skins, JointsPlaceTheMeshAndItsNodeDoesNot) {
    writer.json["nodes"][0]["translation"] = {5, 0, 0};
    writer.json["nodes"][0]["scale"] = {3, 3, 3};
    writer.json["nodes"][1].update({{"translation", {0, 1, 0}}, {"scale", {0.01, 0.01, 0.01}}});
    const Scene scene = load();
    EXPECT_TRUE(scene.warnings.empty());
    const std::vector<Vertex> vertices = posed(scene);
    for (size_t i = 0; i < 4; ++i) expect_near(vertices[i].position, 0.01f * corners[i] + glm::vec3(0, 1, 0), 1e-7f);
    const auto [low, high] = scene_bounds(scene, pose_scene(scene, 0));
    expect_near(low, {0, 1, 0}, 1e-7f);
    expect_near(high, {0.01f, 1.01f, 0}, 1e-7f);
}

TEST_F(Skins, BlendedMatricesMovePositionsAndTheirInverseTransposesNormals) {
    // One joint below the other, both with bind matrices: the hip turned and moved, the knee stretched and sheared.
    writer.json["scenes"][0]["nodes"] = {0, 1};
    writer.json["nodes"][1].update(
        {{"translation", {0.5, -1, 2}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}, {"children", {2}}});
    writer.json["nodes"][2]["matrix"] = {2, 0, 0.5, 0, 0, 1, 0, 0, 0.25, 0, 0.5, 0, 0, 3, 0, 1};
    const glm::mat4 bind_a = glm::translate(glm::mat4(1), glm::vec3(-0.25f, 0, 0)),
                    bind_b = glm::scale(glm::mat4(1), glm::vec3(1, 2, 1));
    set_inverse_bind({bind_a, bind_b});
    follow({0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0},
           {0.25f, 0.75f, 0, 0, 0.5f, 0.5f, 0, 0, 0.125f, 0.875f, 0, 0, 1, 0, 0, 0});
    const std::vector<glm::dvec2> weights = {{0.25, 0.75}, {0.5, 0.5}, {0.125, 0.875}, {0, 1}};  // of a and b

    const Scene scene = with_normal_map(load());
    const ScenePose pose = pose_scene(scene, 0);
    const glm::dmat4 hip = glm::dmat4(pose.world_from_node[1]) * glm::dmat4(bind_a),
                     knee = glm::dmat4(pose.world_from_node[2]) * glm::dmat4(bind_b);
    const std::vector<Vertex> vertices = posed(scene);
    const Mesh& mesh = scene.meshes[0];
    for (size_t i = 0; i < 4; ++i) {
        const glm::dmat4 blended = weights[i].x * hip + weights[i].y * knee;
        const glm::dvec3 normal =
            glm::normalize(glm::transpose(glm::inverse(glm::dmat3(blended))) * glm::dvec3(mesh.vertices[i].normal));
        expect_near(vertices[i].position, glm::vec3(blended * glm::dvec4(corners[i], 1)), 2e-6f);
        expect_near(vertices[i].normal, glm::vec3(normal), 1e-6f);
        // Of the tangent that part which is perpendicular to the normal (section 3.7.2.1: both unit).
        const glm::dvec3 along = glm::dmat3(blended) * glm::dvec3(mesh.vertices[i].tangent);
        expect_near(glm::vec3(vertices[i].tangent), glm::vec3(glm::normalize(along - normal * glm::dot(normal, along))),
                    1e-6f);
        EXPECT_EQ(vertices[i].tangent.w, mesh.vertices[i].tangent.w);
    }
}

TEST_F(Skins, MoreThanFourJointsComeInSets) {
    for (int joint = 3; joint < 6; ++joint) writer.json["nodes"].push_back({{"translation", {0, 0, joint}}});
    writer.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5};
    writer.json["skins"][0]["joints"] = {1, 2, 3, 4, 5};
    follow({0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3}, std::vector<float>(16, 0.2f));
    follow({4, 0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0},
           {0.2f, 0, 0, 0, 0.2f, 0, 0, 0, 0.2f, 0, 0, 0, 0.2f, 0, 0, 0}, "1");
    const Scene scene = load();
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.meshes[0].joints_per_vertex, 5u);
    for (size_t i = 0; i < 4; ++i)
        expect_near(posed(scene)[i].position, corners[i] + glm::vec3(0, 0, 0.2f * (3 + 4 + 5)), 1e-6f);
}

TEST_F(Skins, WeightsSumToOneOrAreSaidNotTo) {
    writer.json["nodes"][1]["translation"] = {0, 0, 2};
    writer.json["nodes"][2]["translation"] = {0, 0, 8};
    square["attributes"]["JOINTS_0"] = writer.bytes_of_4({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    square["attributes"]["WEIGHTS_0"] =
        writer.bytes_of_4({85, 170, 0, 0, 85, 170, 0, 0, 85, 170, 0, 0, 84, 170, 0, 0}, true);
    writer.json["meshes"][0]["primitives"] = {square};
    const Scene bytes = load();
    EXPECT_TRUE(bytes.warnings.empty()) << "rounding of bytes";
    EXPECT_NEAR(posed(bytes)[0].position.z, 6.0f, 1e-6f);
    EXPECT_NEAR(posed(bytes)[3].position.z, (84 * 2 + 170 * 8) / 254.0f, 1e-5f);

    follow(std::vector<uint8_t>(16, 1), {0.5f, 0, 0, 0, 1, 0, 0, 0, 2, 2, 0, 0, 0, 0, 0, 0});
    const Scene scene = load();
    EXPECT_TRUE(mentions(scene.warnings, "The joint weights of 2 vertices of mesh '' do not sum to 1"));
    for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(posed(scene)[i].position.z, 8.0f, 1e-6f);
    EXPECT_NEAR(posed(scene)[3].position.z, 2.0f, 1e-6f) << "follows the skin's first joint";
    follow(std::vector<uint8_t>(16, 1), {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_TRUE(mentions(load().warnings, "1 vertices of mesh '' follow no joint"));
}

TEST_F(Skins, AMeshIsDrawnWithOneAndAnotherAndNone) {
    writer.json["nodes"][2]["translation"] = {7, 0, 0};
    writer.json["nodes"].push_back({{"mesh", 0}, {"skin", 1}, {"translation", {1, 1, 1}}});
    writer.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 9, 0}}});
    writer.json["nodes"].push_back({{"skin", 0}});  // draws nothing
    writer.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5};
    writer.json["skins"] = {{{"joints", {1, 2}}}, {{"joints", {2}}, {"skeleton", 2}}};
    const Scene scene = load();
    EXPECT_TRUE(scene.warnings.empty());
    expect_near(posed(scene, 0)[0].position, {0, 0, 0}, 0);
    expect_near(posed(scene, 1)[0].position, {7, 0, 0}, 0);
    expect_near(posed(scene, 2)[0].position, {0, 9, 0}, 0);
}

TEST_F(Skins, PosedMeshesStandAsTheyWereWithoutJoints) {
    writer.json["nodes"][1].update({{"scale", {-2, 1, 1}}, {"translation", {0, 3, 0}}});
    writer.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 9, 0}}});
    writer.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const Scene scene = load();
    const ScenePose pose = pose_scene(scene, 0);
    Scene storage;
    const Scene& rigid = with_posed_meshes(scene, pose, storage);
    ASSERT_EQ(rigid.instances.size(), 2u);
    EXPECT_TRUE(pose_scene(rigid, 0).deformations.empty());
    EXPECT_EQ(rigid.instances[1].mesh, 0u) << "nothing deforms the second";
    const Mesh& mesh = rigid.meshes[rigid.instances[0].mesh];
    EXPECT_EQ(mesh.indices, scene.meshes[0].indices);
    for (size_t i = 0; i < 4; ++i)
        expect_near(pose.world_from_instance[0] * glm::vec4(mesh.vertices[i].position, 1),
                    corners[i] * glm::vec3(-2, 1, 1) + glm::vec3(0, 3, 0), 1e-6f);
}

TEST_F(Skins, MirroringJointsKeepTheFrontAsMirroringNodesDo) {
    writer.json["nodes"][1]["scale"] = {-1, 1, 1};
    const Scene scene = with_normal_map(load());
    EXPECT_LT(glm::determinant(pose_scene(scene, 0).world_from_instance[0]), 0.0f) << "which turns the front's winding";
    Mesh as_below_a_node = scene.meshes[0];
    for (size_t i = 0; i < 4; ++i) {
        const Vertex &own = as_below_a_node.vertices[i], vertex = posed(scene)[i];
        const glm::vec3 mirror(-1, 1, 1);
        expect_near(vertex.position, own.position * mirror, 0);
        expect_near(vertex.normal, own.normal * mirror, 1e-6f);
        expect_near(glm::vec3(vertex.tangent), glm::vec3(own.tangent) * mirror, 1e-6f);
        EXPECT_EQ(vertex.tangent.w, -own.tangent.w);
    }
}

TEST_F(Skins, BoxesAndPlanesHoldWhatMoves) {
    follow({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0},
           {0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 0.25f, 0.75f, 0, 0, 1, 0, 0, 0});
    square["targets"] = {{{"POSITION", writer.floats({0, 0, 1, 0, 2, -1, 0, 0, 0, -3, 0, 0}, "VEC3")}}};
    writer.json["meshes"][0] = {{"primitives", {square}}, {"weights", {-0.5}}};
    const int times = writer.floats({0, 1}, "SCALAR"), turned = writer.floats({0, 0, 0, 1, 0.6f, 0, 0, 0.8f}, "VEC4"),
              moved = writer.floats({0, 0, 0, 2, 0, 8}, "VEC3");
    writer.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", turned}}, {{"input", times}, {"output", moved}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}},
           {{"sampler", 1}, {"target", {{"node", 2}, {"path", "translation"}}}}}}}};
    const Scene scene = load();
    const InstanceBounds bounds(scene);
    SceneCamera camera{
        .vertical_fov = 0.9f, .keys = {{.position = {0, 0, 12}, .target = {0, 0, 0}}}, .frame_count = 31};
    const CameraPlanes planes = derive_planes(camera, scene);
    for (const float frame : {0.0f, 11.5f, 30.0f}) {
        const Box box = bounds.at(pose_scene(scene, frame), 0);
        for (const Vertex& vertex : posed(scene, 0, frame)) {
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_LE(box.low[axis], vertex.position[axis]) << frame;
                EXPECT_GE(box.high[axis], vertex.position[axis]) << frame;
            }
            EXPECT_GT(12 - vertex.position.z, planes.near) << frame;
            EXPECT_LT(12 - vertex.position.z, planes.far) << frame;
        }
        EXPECT_LT(box.high.z - box.low.z, 20.0) << "about the size of what moves";
    }
    EXPECT_GT(planes.near, 0.5f) << "the knee comes within some 4 m of the eye";
}

TEST_F(Skins, WithoutNormalsTheDeformedTrianglesAreFlat) {
    square["attributes"].erase("NORMAL");
    follow({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    writer.json["nodes"][2]["translation"] = {0, 0, 1};  // lifts the third corner, of both triangles
    const Scene scene = load();
    const std::vector<Vertex> vertices = posed(scene);
    ASSERT_EQ(vertices.size(), 6u);
    for (size_t corner = 0; corner < 6; ++corner) {
        // z = y in the first triangle (0 0 0, 1 0 0, 1 1 1), z = x in the second (0 0 0, 1 1 1, 0 1 0).
        const glm::vec3 normal = corner < 3 ? glm::vec3(0, -1, 1) : glm::vec3(-1, 0, 1);
        expect_near(vertices[scene.meshes[0].indices[corner]].normal, glm::normalize(normal), 1e-6f);
    }
}

TEST_F(Skins, WhatCannotBeFollowedIsRefused) {
    const auto said = [&] { return error_message([&] { load(); }); };
    writer.json["scenes"][0]["nodes"] = {0, 1};
    EXPECT_NE(said().find("skin 0 ('') names the joint 2 ('knee'), which is not in the scene"), std::string::npos)
        << said();
    writer.json["scenes"][0]["nodes"] = {0, 1, 2};
    set_inverse_bind({glm::mat4(1)});
    EXPECT_NE(said().find("skin 0 ('') has 2 joints, but only 1 inverseBindMatrices"), std::string::npos) << said();
    writer.json["skins"][0].erase("inverseBindMatrices");
    writer.json["nodes"][0]["skin"] = 3;
    EXPECT_NE(said().find("node 'body': skin 3 does not exist; there are 1"), std::string::npos) << said();
    writer.json["nodes"][0]["skin"] = 0;
    writer.json["skins"][0]["joints"] = {1, 8};
    EXPECT_NE(said().find("joint 8 does not exist"), std::string::npos) << said();
    writer.json["skins"][0]["joints"] = nlohmann::json::array();
    EXPECT_NE(said().find("skin 0 ('') has no joints"), std::string::npos) << said();
    writer.json["skins"][0]["joints"] = {1, 2};
    follow(std::vector<uint8_t>(16, 2), std::vector<float>(16, 0.25f));
    EXPECT_NE(said().find("mesh '' follows joint 2 of skin 0 (''), which has 2"), std::string::npos) << said();
    follow(std::vector<uint8_t>(16, 0), {1, 0, 0, 0, 1.5f, -0.5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    EXPECT_NE(said().find("WEIGHTS_0: element 1 has the weight -0.5"), std::string::npos) << said();
    square["attributes"].erase("WEIGHTS_0");
    writer.json["meshes"][0]["primitives"] = {square};
    const Scene scene = load();
    EXPECT_TRUE(mentions(scene.warnings, "The skin of node 'body' does not move mesh ''"));
    EXPECT_TRUE(mentions(scene.warnings, "JOINTS_0 of mesh '' is ignored"));
    EXPECT_EQ(scene.instances[0].skin, -1);
}

TEST_F(Skins, MemoryIsSetAsideForEachThatIsDrawn) {
    constexpr size_t vertices = 20000;
    square = {{"attributes", {{"POSITION", writer.floats(std::vector<float>(3 * vertices), "VEC3")}}}, {"mode", 5}};
    std::vector<float> weights;
    for (size_t i = 0; i < vertices; ++i) weights.insert(weights.end(), {1, 0, 0, 0});
    follow(std::vector<uint8_t>(4 * vertices), weights);
    const auto draw_copies = [&](int count) {
        while (writer.json["nodes"].size() > 3) writer.json["nodes"].erase(3);
        writer.json["scenes"][0]["nodes"] = {0, 1, 2};
        for (int i = 3; i < 3 + count; ++i) {
            writer.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
            writer.json["scenes"][0]["nodes"].push_back(i);
        }
        return load();
    };
    const uint64_t usual = reading_limits().memory;
    reading_limits().memory = 200'000'000;  // one takes 4 times 60 000 vertices of 72 B, flat shaded: 17 MB
    draw_copies(2);
    const std::string said = error_message([&] { draw_copies(11); });
    reading_limits().memory = usual;
    EXPECT_NE(said.find("which draws 59994 deformed vertices"), std::string::npos) << said;
}
