// Compressed geometry, made here by the libraries' encoders: what is read is what was compressed.
#include "core/files.h"
#include "tests/reading_limits.h"
#include "tests/scene/gltf_fixture.h"

#include <meshoptimizer.h>
#include <glm/gtc/type_ptr.hpp>
#include <random>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#pragma GCC diagnostic pop

namespace {

struct Compressed : Gltf {
    static constexpr unsigned side = 9;  ///< a height field of side x side vertices
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> uvs;
    std::vector<uint32_t> indices;

    void SetUp() override {
        Gltf::SetUp();
        for (unsigned y = 0; y < side; ++y)
            for (unsigned x = 0; x < side; ++x) {
                positions.emplace_back(x, y, float(x * y % 5));
                normals.push_back(glm::normalize(glm::vec3(float(x) - 4, float(y) - 4, 3)));
                uvs.emplace_back(float(x) / 8, float(y) / 8);
            }
        for (uint32_t y = 0; y + 1 < side; ++y)
            for (uint32_t x = 0; x + 1 < side; ++x) {
                const uint32_t at = y * side + x;
                indices.insert(indices.end(), {at, at + 1, at + side, at + 1, at + side + 1, at + side});
            }
    }
    int accessor(const char* type, size_t count, int component_type = 5126) {
        writer.json["accessors"].push_back({{"componentType", component_type}, {"type", type}, {"count", count}});
        return int(writer.json["accessors"].size()) - 1;
    }
    nlohmann::json& last_accessor() { return writer.json["accessors"].back(); }

    /// Of each mutation either a scene or an Error comes, never a crash; how often an Error.
    unsigned refused_mutations(unsigned count) {
        const std::vector<std::byte> whole = writer.bytes;
        std::mt19937 random(7);
        unsigned refused = 0;
        for (unsigned i = 0; i < count; ++i) {
            writer.bytes = whole;
            for (unsigned flips = 1 + random() % 4; flips > 0; --flips)
                writer.bytes[random() % whole.size()] = std::byte(random());
            refused += error_message([&] { load(); }) != "no error";
        }
        writer.bytes = whole;
        return refused;
    }
};

struct Meshopt : Compressed {
    std::string extension = "EXT_meshopt_compression";

    /// A buffer view that shows `count` elements of `stride` bytes, which it has compressed only.
    int view(const std::string& bytes, size_t stride, size_t count, const char* mode, const char* filter = "NONE") {
        const int compressed = writer.view(bytes.data(), bytes.size());
        nlohmann::json& added = writer.json["bufferViews"][size_t(compressed)];
        nlohmann::json ext = {{"buffer", 0},
                              {"byteOffset", added["byteOffset"]},
                              {"byteLength", bytes.size()},
                              {"byteStride", stride},
                              {"count", count},
                              {"mode", mode},
                              {"filter", filter}};
        added = {{"buffer", 1}, {"byteOffset", 0}, {"byteLength", stride * count}, {"extensions", {{extension, ext}}}};
        if (mode == std::string("ATTRIBUTES")) added["byteStride"] = stride;
        return compressed;
    }
    template <class T>
    int attributes(const std::vector<T>& values, const char* filter = "NONE") {
        std::string bytes(meshopt_encodeVertexBufferBound(values.size(), sizeof(T)), '\0');
        bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                                values.data(), values.size(), sizeof(T)));
        return view(bytes, sizeof(T), values.size(), "ATTRIBUTES", filter);
    }
    int triangles() {
        std::string bytes(meshopt_encodeIndexBufferBound(indices.size(), positions.size()), '\0');
        bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                               indices.data(), indices.size()));
        return view(bytes, 2, indices.size(), "TRIANGLES");
    }
    int sequence() {
        std::string bytes(meshopt_encodeIndexSequenceBound(indices.size(), positions.size()), '\0');
        bytes.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                                 indices.data(), indices.size()));
        return view(bytes, 4, indices.size(), "INDICES");
    }
    int shown_by(int view_index, const char* type, size_t count, int component_type = 5126) {
        const int added = accessor(type, count, component_type);
        last_accessor()["bufferView"] = view_index;
        return added;
    }
    /// The height field, with normals as filtered octahedra and texture coordinates as filtered floats.
    void add_height_field() {
        std::vector<glm::i8vec4> octahedra(normals.size());
        std::vector<glm::vec4> source;
        for (const glm::vec3& n : normals) source.emplace_back(n, 0.0f);
        meshopt_encodeFilterOct(octahedra.data(), octahedra.size(), 4, 8, glm::value_ptr(source[0]));
        std::vector<glm::uvec2> exponents(uvs.size());
        meshopt_encodeFilterExp(exponents.data(), exponents.size(), 8, 24, glm::value_ptr(uvs[0]));
        const size_t count = positions.size();
        nlohmann::json primitive;
        primitive["attributes"]["POSITION"] = shown_by(attributes(positions), "VEC3", count);
        primitive["attributes"]["NORMAL"] = shown_by(attributes(octahedra, "OCTAHEDRAL"), "VEC3", count, 5120);
        last_accessor()["normalized"] = true;
        primitive["attributes"]["TEXCOORD_0"] = shown_by(attributes(exponents, "EXPONENTIAL"), "VEC2", count);
        primitive["indices"] = shown_by(triangles(), "SCALAR", indices.size(), 5123);
        writer.add_mesh_node(primitive);
        writer.json["extensionsRequired"] = {extension};
    }
    Scene load_compressed() {
        const fs::path file = writer.write_glb(folder / "a.glb");
        nlohmann::json json = writer.json;  // with the buffer that has no data, as the extension wants it
        json["buffers"].push_back({{"byteLength", 1 << 20}, {"extensions", {{extension, {{"fallback", true}}}}}});
        json["buffers"][0]["uri"] = "a.bin";
        write_text(folder / "a.bin", {reinterpret_cast<const char*>(writer.bytes.data()), writer.bytes.size()});
        write_text(folder / "a.gltf", json.dump());
        return load_gltf(folder / "a.gltf");
    }
    std::string said() {
        return error_message([&] { load_compressed(); });
    }
};

struct Draco : Compressed {
    /// The height field as one primitive, whose accessors have no data of their own.
    void add_height_field(int method, int seams = 0) {
        draco::TriangleSoupMeshBuilder builder;
        builder.Start(int(indices.size() / 3));
        const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
        const int normal = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
        const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
        const int color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
        for (size_t i = 0; i < indices.size(); i += 3) {
            const draco::FaceIndex face{uint32_t(i / 3)};
            const uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
            builder.SetAttributeValuesForFace(position, face, &positions[a], &positions[b], &positions[c]);
            builder.SetAttributeValuesForFace(normal, face, &normals[a], &normals[b], &normals[c]);
            // The first triangles have texture coordinates of their own: more vertices than positions.
            glm::vec2 moved[3] = {uvs[a], uvs[b], uvs[c]};
            if (int(i / 3) < seams)
                for (glm::vec2& at : moved) at += 4.0f;
            builder.SetAttributeValuesForFace(uv, face, &moved[0], &moved[1], &moved[2]);
            const glm::u8vec4 shade[3] = {{a, 1, 2, 255}, {b, 1, 2, 255}, {c, 1, 2, 255}};
            builder.SetAttributeValuesForFace(color, face, &shade[0], &shade[1], &shade[2]);
        }
        const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
        draco::Encoder encoder;
        encoder.SetEncodingMethod(method);
        encoder.SetTrackEncodedProperties(true);
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
        encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 10);
        encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
        draco::EncoderBuffer buffer;
        ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
        const size_t count = encoder.num_encoded_points(), faces = encoder.num_encoded_faces();
        ASSERT_EQ(faces * 3, indices.size());
        const int data = writer.view(buffer.data(), buffer.size());
        nlohmann::json primitive;
        nlohmann::json& given = primitive["attributes"];
        given["POSITION"] = accessor("VEC3", count), given["NORMAL"] = accessor("VEC3", count);
        given["TEXCOORD_0"] = accessor("VEC2", count), given["COLOR_0"] = accessor("VEC4", count, 5121);
        last_accessor()["normalized"] = true;
        primitive["indices"] = accessor("SCALAR", faces * 3, 5123);
        primitive["extensions"]["KHR_draco_mesh_compression"] = {
            {"bufferView", data},
            {"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}, {"COLOR_0", color}}}};
        writer.add_mesh_node(primitive);
        writer.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    }
};

void expect_same_triangles(const Compressed& source, const Mesh& mesh, float position_step, float normal_step,
                           float uv_step) {
    ASSERT_EQ(mesh.indices.size(), source.indices.size());
    // Encoders reorder triangles and vertices: a triangle is found again by its corners.
    const auto key = [](const glm::vec3& p) { return std::lround(p.x) + 100 * std::lround(p.y); };
    std::multiset<std::set<long>> expected, found;
    for (size_t i = 0; i < source.indices.size(); i += 3) {
        std::set<long> corners, read;
        for (size_t k = i; k < i + 3; ++k) {
            corners.insert(key(source.positions[source.indices[k]]));
            read.insert(key(mesh.vertices[mesh.indices[k]].position));
        }
        expected.insert(corners), found.insert(read);
    }
    EXPECT_EQ(expected, found);
    for (const Vertex& v : mesh.vertices) {
        const size_t at = size_t(std::lround(v.position.x)) + Compressed::side * size_t(std::lround(v.position.y));
        ASSERT_LT(at, source.positions.size());
        expect_near(v.position, source.positions[at], position_step);
        expect_near(v.normal, source.normals[at], normal_step);
        const glm::vec2 uv = glm::fract(v.uv[0] * 0.25f) * 4.0f;  // without the 4 of seams
        EXPECT_NEAR(uv.x, source.uvs[at].x, uv_step);
        EXPECT_NEAR(uv.y, source.uvs[at].y, uv_step);
    }
}
}  // namespace

TEST_F(Meshopt, DecodesAllModesAndFilters) {
    add_height_field();
    const Scene scene = load_compressed();
    // Positions are kept; octahedra of 8 bits are off by a step of 1 / 127 at most; 23 bits hold the coordinates.
    expect_same_triangles(*this, scene.meshes.at(0), 0.0f, 1.5f / 127.0f, 1e-6f);
    EXPECT_TRUE(scene.warnings.empty());
    writer.json["meshes"][0]["primitives"][0]["indices"] = shown_by(sequence(), "SCALAR", indices.size(), 5125);
    const Scene in_sequence = load_compressed();
    EXPECT_EQ(in_sequence.meshes.at(0).indices, indices);  // which this mode keeps in order

    // A quarter turn about z as 16-bit quaternions.
    const float half = std::sqrt(0.5f), turns[8] = {0, 0, 0, 1, 0, 0, half, half};
    std::vector<glm::i16vec4> rotations(2);
    meshopt_encodeFilterQuat(rotations.data(), 2, 8, 16, turns);
    const int values = shown_by(attributes(rotations, "QUATERNION"), "VEC4", 2, 5122);
    last_accessor()["normalized"] = true;
    const int times = shown_by(attributes(std::vector<float>{0, 1}), "SCALAR", 2);
    writer.json["animations"] = {{{"samplers", {{{"input", times}, {"output", values}}}},
                                  {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
    const Scene turned = load_compressed();
    expect_near(turned.animation.at(0).values.at(1), {0, 0, half}, 2.0f / 32767.0f);
    for (std::string& name : std::vector<std::string>{"KHR_meshopt_compression"}) {
        nlohmann::json& views = writer.json["bufferViews"];
        for (nlohmann::json& view : views)
            if (view.contains("extensions")) view["extensions"] = {{name, view["extensions"][extension]}};
        extension = name;
        writer.json["extensionsRequired"] = {name};
        EXPECT_EQ(load_compressed().content_hash, turned.content_hash);
    }
}

TEST_F(Meshopt, RefusesWhatDoesNotFitAndTakesTheFallback) {
    add_height_field();
    const nlohmann::json whole = writer.json;
    const auto with = [&](const char* key, const nlohmann::json& value) {
        writer.json = whole;
        writer.json["bufferViews"][0]["extensions"][extension][key] = value;
        return said();
    };
    EXPECT_NE(with("byteStride", 10).find("bufferViews[0].EXT_meshopt_compression: the mode ATTRIBUTES needs a stride"),
              std::string::npos);
    EXPECT_NE(with("count", 82).find("82 elements of 12 bytes do not fill its byteLength of 972"), std::string::npos);
    EXPECT_NE(with("byteOffset", 1 << 20).find("pass the end of its buffer"), std::string::npos);
    EXPECT_NE(with("mode", "POINTS").find("must be one of"), std::string::npos);
    EXPECT_NE(with("filter", "QUATERNION").find("needs a stride of 8"), std::string::npos);
    EXPECT_NE(with("mode", "INDICES").find("INDICES needs a stride of 2 or 4"), std::string::npos);
    {
        const LimitsOf limits({.memory = 1'000'000'000});
        writer.json = whole;
        nlohmann::json& view = writer.json["bufferViews"][0];
        view["byteLength"] = size_t(12) * 300'000'000, view["extensions"][extension]["count"] = 300'000'000;
        EXPECT_NE(said().find("--max-memory"), std::string::npos) << said();
    }
    writer.json = whole;
    EXPECT_GT(refused_mutations(150), 10u);

    // Damaged, or of a version that is not known: what stands in its place is shown if there is something.
    const size_t at = whole["bufferViews"][0]["extensions"][extension]["byteOffset"];
    writer.bytes[at] = std::byte(0x55);
    EXPECT_NE(said().find("cannot be decoded"), std::string::npos) << said();
    EXPECT_NE(said().find("gltfpack"), std::string::npos);
    const int plain = writer.view(positions.data(), positions.size() * sizeof(glm::vec3));
    writer.json["bufferViews"][0]["buffer"] = 0;
    writer.json["bufferViews"][0]["byteOffset"] = writer.json["bufferViews"][size_t(plain)]["byteOffset"];
    writer.json.erase("extensionsRequired");
    const Scene scene = load_compressed();
    EXPECT_EQ(scene.meshes.at(0).vertices.at(80).position, positions[80]);
    EXPECT_TRUE(mentions(scene.warnings, "buffer view 0 cannot be decoded; the file's fallback is shown"));
}

TEST_F(Draco, DecodesBothMethods) {
    // Steps of the quantisation: 8 m in 2^14, a unit in 2^10 with octahedral spacing, 5 in 2^12.
    for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING})
        for (const int seams : {0, 5}) {
            writer = {};
            ASSERT_NO_FATAL_FAILURE(add_height_field(method, seams));
            const Scene scene = load();
            expect_same_triangles(*this, scene.meshes.at(0), 8.0f / 16384, 4.0f / 1024, 5.0f / 4096);
            EXPECT_EQ(scene.meshes[0].vertices.size() > positions.size(), seams > 0);
            EXPECT_TRUE(scene.warnings.empty());
            for (const Vertex& v : scene.meshes[0].vertices) {
                const float index = std::round(v.position.x) + float(side) * std::round(v.position.y);
                EXPECT_EQ(v.color, glm::vec4(index, 1, 2, 255) / 255.0f);  // whole numbers are kept
            }
        }
}

TEST_F(Draco, RefusesWhatDoesNotFitAndTakesTheFallback) {
    for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
        writer = {};
        ASSERT_NO_FATAL_FAILURE(add_height_field(method));
        EXPECT_GT(refused_mutations(40), 5u);
    }
    const auto said = [&] { return error_message([&] { load(); }); };
    const nlohmann::json whole = writer.json;
    nlohmann::json& extension = writer.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
    extension["attributes"]["NORMAL"] = 77;
    EXPECT_NE(said().find("KHR_draco_mesh_compression, NORMAL: its Draco data have no attribute with the id 77"),
              std::string::npos)
        << said();
    writer.json = whole;
    writer.json["accessors"][1]["type"] = "VEC4";
    EXPECT_NE(said().find("has 4 components, but 3 in its Draco data"), std::string::npos) << said();
    writer.json = whole;
    // Four thousand million triangles in a few bytes: the numbers behind the header and the kind of traversal.
    const std::vector<std::byte> whole_bytes = writer.bytes;
    for (size_t i = 0; i < 10; ++i) writer.bytes[11 + i] = std::byte(i % 5 == 4 ? 0x0F : 0xFF);
    {
        const LimitsOf limits({.memory = 1'000'000'000});
        EXPECT_NE(said().find("triangles and 4294967295 vertices needs"), std::string::npos) << said();
        EXPECT_NE(said().find("--max-memory"), std::string::npos) << said();
    }
    writer.bytes = whole_bytes;
    writer.bytes[6] = std::byte(9);  // of the version
    EXPECT_NE(said().find("of version 2.9, but the extension has 2.2; `gltf-transform copy"), std::string::npos)
        << said();
    writer.bytes[0] = std::byte('X');
    EXPECT_NE(said().find("KHR_draco_mesh_compression: its buffer view holds no Draco data"), std::string::npos)
        << said();
    // Accessors that have data of their own are a fallback.
    nlohmann::json quad = writer.quad();
    quad["extensions"] = writer.json["meshes"][0]["primitives"][0]["extensions"];
    writer.json["meshes"][0]["primitives"] = {quad};
    writer.json.erase("extensionsRequired");
    const Scene scene = load();
    EXPECT_EQ(scene.triangle_count(), 2u);
    EXPECT_TRUE(mentions(scene.warnings, "KHR_draco_mesh_compression of mesh 0 primitive 0 cannot be decoded"));
}
