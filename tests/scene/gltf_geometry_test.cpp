#include "core/scene/gltf/tangents.h"
#include "tests/scene/gltf_fixture.h"

#include <cmath>

using Geometry = Gltf;

namespace {
/// Corners of the triangles of a mesh without normals, whose vertices were split per triangle.
std::vector<glm::vec3> corners(const Mesh& mesh) {
    std::vector<glm::vec3> found;
    for (const uint32_t index : mesh.indices) found.push_back(mesh.vertices[index].position);
    return found;
}
const std::vector<float> zigzag = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
}  // namespace

TEST_F(Geometry, StripsKeepFacingOneWay) {
    const Mesh mesh = load_mesh({{"mode", 5}, {"attributes", {{"POSITION", writer.floats(zigzag, "VEC3")}}}});
    ASSERT_EQ(mesh.indices.size(), 9u);
    for (const Vertex& v : mesh.vertices) expect_near(v.normal, {0, 0, 1}, 1e-6f);
}

TEST_F(Geometry, FansShareTheirFirstVertex) {
    const int positions = writer.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    const Mesh mesh =
        load_mesh({{"mode", 6}, {"attributes", {{"POSITION", positions}}}, {"indices", writer.indices({0, 1, 2, 3})}});
    ASSERT_EQ(mesh.indices.size(), 6u);
    const auto points = corners(mesh);
    for (const size_t first : {0, 3})
        EXPECT_TRUE(std::find(points.begin() + long(first), points.begin() + long(first) + 3, glm::vec3(0)) !=
                    points.begin() + long(first) + 3);
    for (const Vertex& v : mesh.vertices) expect_near(v.normal, {0, 0, 1}, 1e-6f);
}

TEST_F(Geometry, PointsAndLonelyJointsAreReported) {
    const int positions = writer.floats(zigzag, "VEC3");
    writer.add_mesh_node({{"mode", 0}, {"attributes", {{"POSITION", positions}}}});
    nlohmann::json quad = writer.quad();
    quad["attributes"]["JOINTS_0"] = writer.floats(std::vector<float>(16, 0.0f), "VEC4");
    writer.json["meshes"].push_back({{"primitives", {quad}}});
    writer.json["nodes"][0] = {{"children", {1}}, {"mesh", 0}};
    writer.json["nodes"].push_back({{"mesh", 1}});
    const Scene scene = load();
    EXPECT_EQ(scene.triangle_count(), 2u);
    for (const char* what : {"Points or lines", "JOINTS_0"}) EXPECT_TRUE(mentions(scene.warnings, what)) << what;
}

TEST_F(Geometry, SparseAccessorsReplaceElements) {
    nlohmann::json quad = writer.quad();
    const uint16_t index = 2;
    const float moved[] = {5, 6, 7};
    auto& accessor = writer.json["accessors"][size_t(quad["attributes"]["POSITION"])];
    accessor["sparse"] = {{"count", 1},
                          {"indices", {{"bufferView", writer.view(&index, sizeof index)}, {"componentType", 5123}}},
                          {"values", {{"bufferView", writer.view(moved, sizeof moved)}}}};
    const Mesh mesh = load_mesh(quad);
    EXPECT_EQ(mesh.vertices.at(2).position, glm::vec3(5, 6, 7));
    EXPECT_EQ(mesh.vertices.at(1).position, glm::vec3(1, 0, 0));
}

TEST_F(Geometry, NormalisedIntegersAndInterleavedVertices) {
    nlohmann::json quad = writer.quad();
    // Colours of 3 unsigned bytes in a stride of 4, and a second set of texture coordinates as signed shorts.
    const uint8_t colors[16] = {255, 0, 51, 0, 255, 0, 51, 0, 255, 0, 51, 0, 255, 0, 51, 0};
    const int16_t uv[8] = {32767, -32768, 0, 16384, 0, 0, 0, 0};
    const int color_view = writer.view(colors, sizeof colors), uv_view = writer.view(uv, sizeof uv);
    writer.json["bufferViews"][size_t(color_view)]["byteStride"] = 4;
    const auto add = [&](nlohmann::json accessor) {
        writer.json["accessors"].push_back(accessor);
        return writer.json["accessors"].size() - 1;
    };
    quad["attributes"]["COLOR_0"] = add(
        {{"bufferView", color_view}, {"componentType", 5121}, {"normalized", true}, {"type", "VEC3"}, {"count", 4}});
    quad["attributes"]["TEXCOORD_1"] =
        add({{"bufferView", uv_view}, {"componentType", 5122}, {"normalized", true}, {"type", "VEC2"}, {"count", 4}});
    const Mesh mesh = load_mesh(quad);
    EXPECT_EQ(mesh.vertices[3].color, glm::vec4(1, 0, 0.2f, 1));
    EXPECT_EQ(mesh.vertices[0].uv[1], glm::vec2(1, -1));
    EXPECT_EQ(mesh.vertices[1].uv[1], glm::vec2(0, 16384.0f / 32767.0f));
}

TEST_F(Geometry, SharedMeshesStayShared) {
    writer.add_mesh_node(writer.quad());
    writer.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}}};
    writer.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.triangle_count(), 4u);
    const auto [low, high] = scene_bounds(scene, pose_scene(scene, 0));
    expect_near(low, {0, 0, 0}, 0);
    expect_near(high, {6, 1, 0}, 0);
}

TEST_F(Geometry, InvalidNumbersAreErrors) {
    nlohmann::json quad = writer.quad();
    writer.add_mesh_node(quad);
    const float nan = std::nanf("");
    const size_t position_view = writer.json["accessors"][size_t(quad["attributes"]["POSITION"])]["bufferView"];
    const size_t offset = writer.json["bufferViews"][position_view]["byteOffset"];
    std::memcpy(&writer.bytes[offset + 16], &nan, 4);
    EXPECT_NE(error_message([&] { load(); }).find("element 1 is not finite"), std::string::npos);
}

TEST_F(Geometry, IndicesOutOfRangeAreErrors) {
    nlohmann::json quad = writer.quad();
    quad["indices"] = writer.indices({0, 1, 9});
    writer.add_mesh_node(quad);
    EXPECT_NE(error_message([&] { load(); }).find("has the index 9, but only 4 vertices"), std::string::npos);
}

TEST(Tangents, SplitVerticesWhoseTexturesAreMirrored) {
    // Two triangles that share the edge x = 0; the right one is textured as the mirror image of the left one: u = |x|.
    Mesh mesh;
    for (const glm::vec2 p : {glm::vec2(-1, 0), glm::vec2(0, -1), glm::vec2(0, 1), glm::vec2(1, 0)})
        mesh.vertices.push_back({.position = {p, 0},
                                 .normal = {0, 0, 1},
                                 .tangent = {},
                                 .uv = {{std::abs(p.x), 0.5f - 0.5f * p.y}, {}},
                                 .color = glm::vec4(1)});
    mesh.indices = {0, 1, 2, 1, 3, 2};
    derive_tangents(mesh, {});
    ASSERT_EQ(mesh.vertices.size(), 6u);  // both vertices of the shared edge
    for (size_t i = 0; i < 6; ++i) {
        const glm::vec4 tangent = mesh.vertices[mesh.indices[i]].tangent;
        const float sign = i < 3 ? -1.0f : 1.0f;  // u grows along -x on the left
        EXPECT_NEAR(tangent.x, sign, 1e-6f);
        EXPECT_EQ(tangent.w, sign);  // so that w cross(n, t) is +y, up in the picture, on both sides
    }
}

TEST(Tangents, AreWeightedByTheAngleAtTheCorner) {
    // Around the apex (0, 0, 0) with normal +z: a triangle of 90 degrees with u along +x, and one of 45 with u along
    // +y.
    Mesh mesh;
    const auto add = [&](glm::vec2 p, glm::vec2 uv) {
        mesh.vertices.push_back(
            {.position = {p, 0}, .normal = {0, 0, 1}, .tangent = {}, .uv = {uv, {}}, .color = glm::vec4(1)});
    };
    add({0, 0}, {0, 0}), add({1, 0}, {1, 0}), add({0, 1}, {0, -1});
    add({0, 0}, {0, 0}), add({-1, 0}, {0, -1}), add({-1, -1}, {-1, -1});
    mesh.indices = {0, 1, 2, 3, 4, 5};
    derive_tangents(mesh, {});
    EXPECT_EQ(mesh.vertices[0].tangent, mesh.vertices[3].tangent);  // equal vertices share their tangent
    expect_near(mesh.vertices[0].tangent, glm::normalize(glm::vec3(2, 1, 0)), 1e-6f);
    EXPECT_EQ(mesh.vertices[0].tangent.w, 1.0f);
}

TEST(Tangents, SurviveDegenerateTextureCoordinates) {
    Mesh mesh;
    for (const glm::vec2 p : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)})
        mesh.vertices.push_back(
            {.position = {p, 0}, .normal = {0, 0, 1}, .tangent = {}, .uv = {{0.5f, 0.5f}, {}}, .color = glm::vec4(1)});
    mesh.indices = {0, 1, 2};
    derive_tangents(mesh, {});
    for (const Vertex& v : mesh.vertices) {
        EXPECT_NEAR(glm::length(glm::vec3(v.tangent)), 1.0f, 1e-6f);
        EXPECT_NEAR(glm::dot(glm::vec3(v.tangent), v.normal), 0.0f, 1e-6f);
        EXPECT_EQ(std::abs(v.tangent.w), 1.0f);
    }
}
