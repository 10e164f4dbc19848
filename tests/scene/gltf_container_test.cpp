// How a file of any valid spelling becomes the same scene, and what is said of those that are none.
#include "core/files.h"
#include "core/png.h"
#include "tests/scene/gltf_fixture.h"

#include <array>

namespace {

struct Container : Gltf {
    std::string glb;   ///< a file of one quad
    std::string hash;  ///< of its scene

    void SetUp() override {
        Gltf::SetUp();
        writer.add_mesh_node(writer.quad());
        glb = read_text(writer.write_glb(folder / "a.glb"));
        hash = load_gltf(folder / "a.glb").content_hash;
    }
    static std::string word(size_t value) {
        std::string text(4, '\0');
        for (int i = 0; i < 4; ++i) text[size_t(i)] = char(value >> (8 * i));
        return text;
    }
    static std::string chunk(const std::string& type, const std::string& data) {
        return word(data.size()) + type + data;
    }
    static std::string glb_of(const std::vector<std::string>& chunks) {
        std::string all;
        for (const std::string& part : chunks) all += part;
        return "glTF" + word(2) + word(12 + all.size()) + all;
    }
    std::string json_chunk() const { return chunk("JSON", writer.json.dump()); }
    std::string buffer_text() const {
        return {reinterpret_cast<const char*>(writer.bytes.data()), writer.bytes.size()};
    }
    std::string binary_chunk() const { return chunk(std::string("BIN\0", 4), buffer_text()); }

    std::string hash_of(const std::string& bytes, const std::string& name = "b.glb") {
        write_text(folder / name, bytes);
        return load_gltf(folder / name).content_hash;
    }
    std::string said_of(const std::string& bytes, const std::string& name = "b.glb") {
        return error_message([&] { hash_of(bytes, name); });
    }
};

std::string escaped(const std::string& bytes) {
    std::string text;
    char code[4];
    for (const char c : bytes) std::snprintf(code, sizeof code, "%%%02x", unsigned(uint8_t(c))), text += code;
    return text;
}
}  // namespace

TEST_F(Container, ChunksOfOtherTypesArePassedByWhereverTheyStand) {
    const std::string other = chunk("TEST", "other data  ");
    EXPECT_EQ(hash_of(glb_of({json_chunk(), binary_chunk(), other})), hash);
    EXPECT_EQ(hash_of(glb_of({json_chunk(), other, binary_chunk()})), hash);
    EXPECT_EQ(hash_of(glb_of({other, json_chunk(), binary_chunk(), other, other})), hash);
    EXPECT_EQ(hash_of(glb + "behind the length that the header says"), hash);
    EXPECT_EQ(hash_of(glb_of({chunk("JSON", writer.json.dump() + std::string(3, '\0')), binary_chunk()})), hash);
    EXPECT_NE(said_of(glb_of({other})).find("no chunk 'JSON'"), std::string::npos);
    EXPECT_NE(said_of(glb_of({json_chunk(), binary_chunk(), binary_chunk()})).find("two chunks 'BIN'"),
              std::string::npos);
    EXPECT_NE(said_of(glb_of({json_chunk(), word(9) + "TEST" + "short"})).find("'TEST' of 9 bytes passes the end"),
              std::string::npos);
    EXPECT_NE(said_of("glTF" + word(1) + word(20) + word(0) + word(0)).find("gltf-pipeline"), std::string::npos);
}

TEST_F(Container, ContentsCountAndNotNames) {
    EXPECT_EQ(hash_of(glb, "b.gltf"), hash);
    const std::string text = read_text(writer.write_gltf(folder / "c.gltf"));
    EXPECT_EQ(hash_of(text, "c.glb"), hash);
    EXPECT_EQ(hash_of("\xEF\xBB\xBF" + text, "c.gltf"), hash);
    EXPECT_NE(said_of("\xFF\xFE{", "c.gltf").find("is UTF-16"), std::string::npos);
    EXPECT_NE(said_of("PK\x03\x04", "c.glb").find("neither a .glb nor a .gltf"), std::string::npos);
    EXPECT_NE(said_of("", "c.gltf").find("is empty"), std::string::npos);
}

TEST_F(Container, IntegersMayBeWrittenAsDecimals) {
    std::string text = read_text(writer.write_gltf(folder / "d.gltf"));
    nlohmann::json json = nlohmann::json::parse(text);
    for (const char* place :
         {"/scene", "/scenes/0/nodes/0", "/nodes/0/mesh", "/meshes/0/primitives/0/indices",
          "/meshes/0/primitives/0/attributes/POSITION", "/accessors/0/count", "/accessors/0/componentType",
          "/accessors/0/bufferView", "/bufferViews/0/buffer", "/bufferViews/1/byteOffset", "/buffers/0/byteLength"}) {
        nlohmann::json& value = json[nlohmann::json::json_pointer(place)];
        ASSERT_TRUE(value.is_number_integer()) << place;
        value = value.get<double>();  // written as 4.0
    }
    EXPECT_EQ(hash_of(json.dump(), "d.gltf"), hash);
    json["nodes"][0]["mesh"] = 0.5;
    EXPECT_NE(said_of(json.dump(), "d.gltf").find("nodes[0].mesh: must be a whole number"), std::string::npos);
    text.replace(text.find("\"scene\": 0"), 10, "\"scene\": 0e0");
    EXPECT_EQ(hash_of(text, "d.gltf"), hash);
}

TEST_F(Container, BuffersMayBeLongerThanTheySayButNotShorter) {
    nlohmann::json json = nlohmann::json::parse(read_text(writer.write_gltf(folder / "e.gltf")));
    const std::string bytes = read_text(folder / "e.bin");
    write_text(folder / "e.bin", bytes + "padding");
    EXPECT_EQ(hash_of(json.dump(), "e.gltf"), hash);
    write_text(folder / "e.bin", bytes.substr(1));
    const std::string size = std::to_string(bytes.size());
    EXPECT_NE(said_of(json.dump(), "e.gltf")
                  .find("has " + std::to_string(bytes.size() - 1) + " bytes, fewer than its byteLength of " + size),
              std::string::npos);
    writer.json["buffers"][0].erase("uri");
    EXPECT_EQ(hash_of(glb_of({json_chunk(), chunk(std::string("BIN\0", 4), buffer_text() + "abc")})), hash);
    EXPECT_NE(said_of(glb_of({json_chunk()})).find("buffers[0] has no 'uri'"), std::string::npos);
    json["buffers"].push_back({{"byteLength", 8}, {"uri", "missing.bin"}});  // which no buffer view shows
    write_text(folder / "e.bin", bytes);
    EXPECT_EQ(hash_of(json.dump(), "e.gltf"), hash);
    json["bufferViews"][0]["byteLength"] = 1 << 20;
    EXPECT_NE(said_of(json.dump(), "e.gltf").find("bufferViews[0]: 1048576 bytes from byte 0 on pass the end"),
              std::string::npos);
}

TEST_F(Container, DataUrisAreReadInEverySpelling) {
    const auto with = [&](const std::string& uri) {
        nlohmann::json json = writer.json;
        json["buffers"] = {{{"byteLength", writer.bytes.size()}, {"uri", uri}}};
        return json.dump();
    };
    const std::string bytes = buffer_text(), letters = base64(bytes);
    std::string percent = letters;
    for (size_t at = 0; (at = percent.find_first_of("+/=", at)) != std::string::npos; at += 3)
        percent.replace(at, 1, escaped(percent.substr(at, 1)));
    const std::string unpadded = letters.substr(0, letters.find('='));
    for (const std::string& uri :
         {"data:application/octet-stream;base64," + letters, "data:;base64," + letters,
          "DATA:Model/Anything;BASE64," + letters,
          "data:application/gltf-buffer;charset=utf-8;name=\"a;b\";base64," + letters, "data:x/y;base64," + percent,
          "data:x/y;base64," + unpadded, "data:x/y;base64,\n" + letters.substr(0, 8) + "\n " + letters.substr(8) + "\n",
          "data:application/octet-stream," + escaped(bytes)})
        EXPECT_EQ(hash_of(with(uri), "f.gltf"), hash) << uri;
    const std::string cut = said_of(with("data:x/y;base64," + letters.substr(0, 40)), "f.gltf");
    EXPECT_NE(cut.find("buffers[0] has 30 bytes, fewer"), std::string::npos) << cut;
    const std::string wrong = said_of(with("data:x/y;base64,AAAA*" + letters), "f.gltf");
    EXPECT_NE(wrong.find("buffers[0] ('data:x/y ("), std::string::npos) << wrong;
    EXPECT_NE(wrong.find("letter 5 of its data is no base64"), std::string::npos) << wrong;
    EXPECT_EQ(wrong.find(letters.substr(0, 12)), std::string::npos) << "data in a message: " << wrong;
    EXPECT_NE(said_of(with("data:x/y;base64"), "f.gltf").find("has a comma before its data"), std::string::npos);
}

TEST_F(Container, NamesOfFilesAreTakenAsUrisAndAsTheyStand) {
    nlohmann::json json = writer.json;
    const auto named = [&](const std::string& file, const std::string& uri) {
        write_text(folder / file, buffer_text());
        json["buffers"] = {{{"byteLength", writer.bytes.size()}, {"uri", uri}}};
        const std::string found = hash_of(json.dump(), "g.gltf");
        fs::remove(folder / file);
        return found;
    };
    fs::create_directories(folder / "take#2/a.b");
    EXPECT_EQ(named("table+chairs.bin", "table+chairs.bin"), hash);
    EXPECT_EQ(named("a+b.bin", "a%2Bb.bin"), hash);
    EXPECT_EQ(named("a b.bin", "a%20b.bin"), hash);
    EXPECT_EQ(named("a b.bin", "./a b.bin"), hash);
    EXPECT_EQ(named("100%.bin", "100%.bin"), hash);
    EXPECT_EQ(named("a%20b.bin", "a%20b.bin"), hash);  // whose name was not percent-encoded
    EXPECT_EQ(named("k\xC3\xBChl.bin", "k%C3%BChl.bin"), hash);
    EXPECT_EQ(named("take#2/a.b/c.bin", "take#2/a.b/c.bin"), hash);
    EXPECT_EQ(named("take#2/a.b/c.bin", "take%232\\a.b\\c.bin"), hash);
    const auto refused = [&](const std::string& uri) { return error_message([&] { named("a.bin", uri); }); };
    EXPECT_NE(refused("table+sofa.bin").find("table+sofa.bin: no such file"), std::string::npos);
    EXPECT_NE(refused("https://example.org/a.bin").find("a URI of the scheme 'https'"), std::string::npos);
    EXPECT_NE(refused("file:///a.bin").find("a URI of the scheme 'file'"), std::string::npos);
    EXPECT_NE(refused("a%00.bin").find("a byte of 0"), std::string::npos);
}

TEST_F(Container, TypesNeedTheirObjects) {
    writer.json["cameras"] = {{{"type", "orthographic"}}};
    EXPECT_NE(error_message([&] { load(); }).find("cameras[0]: lacks the key 'orthographic'"), std::string::npos);
    writer.json.erase("cameras");
    writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}};
    EXPECT_NE(error_message([&] { load(); }).find("lights[0]: lacks the key 'spot'"), std::string::npos);
}

TEST_F(Container, StridesOfAnyNumberOfBytesAreTaken) {
    // Positions as three bytes each, packed, and the same with a stride of 5.
    const std::array<int8_t, 12> packed = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    std::array<int8_t, 18> spaced{};
    for (size_t i = 0; i < 12; ++i) spaced[i / 3 * 5 + i % 3] = packed[i];
    const auto positions = [&](const void* data, size_t size, int stride) {
        const int view = writer.view(data, size);
        if (stride) writer.json["bufferViews"][size_t(view)]["byteStride"] = stride;
        writer.json["accessors"].push_back(
            {{"bufferView", view}, {"componentType", 5120}, {"type", "VEC3"}, {"count", 4}});
        writer.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = writer.json["accessors"].size() - 1;
        return load().content_hash;
    };
    EXPECT_EQ(positions(packed.data(), packed.size(), 0), hash);
    EXPECT_EQ(positions(spaced.data(), spaced.size(), 5), hash);
}

TEST_F(Container, OneReaderOfAccessorsKnowsZerosAndSparseParts) {
    nlohmann::json& primitive = writer.json["meshes"][0]["primitives"][0];
    nlohmann::json& accessor = writer.json["accessors"][primitive["indices"].get<size_t>()];
    // 0 1 2 0 2 0, of which the last becomes 3: the quad.
    const std::vector<uint16_t> base = {0, 1, 2, 0, 2, 0};
    const uint16_t five = 5, three = 3;
    accessor["bufferView"] = writer.view(base.data(), 12);
    accessor["sparse"] = {{"count", 1},
                          {"indices", {{"bufferView", writer.view(&five, 2)}, {"componentType", 5123}}},
                          {"values", {{"bufferView", writer.view(&three, 2)}}}};
    EXPECT_EQ(load().content_hash, hash);
    // Zeros without a buffer view: triangles of no area, or what the sparse part makes of them.
    accessor.erase("bufferView");
    EXPECT_EQ(load().meshes.at(0).indices, (std::vector<uint32_t>{0, 0, 0, 0, 0, 3}));
    accessor.erase("sparse");
    EXPECT_EQ(load().meshes.at(0).indices, std::vector<uint32_t>(6, 0));
    accessor["count"] = 7;
    EXPECT_NE(error_message([&] { load(); }).find("7 indices, no multiple of 3"), std::string::npos);
    primitive["indices"] = 99;
    EXPECT_NE(error_message([&] { load(); }).find("indices: accessor 99 does not exist"), std::string::npos);
}
