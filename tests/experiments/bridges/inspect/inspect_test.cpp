// What `ssrlab inspect` says of small scenes and images whose facts are known, and which shares warnings get.
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/png.h"
#include "experiments/bridges/inspect/describe.h"
#include "experiments/bridges/inspect/first_view_images.h"
#include "experiments/bridges/inspect/inspect_hint.h"
#include "experiments/bridges/inspect/page.h"
#include "experiments/study/config/shots/scene_warnings.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>
#include <cmath>
#include <filesystem>
#include <limits>

namespace fs = std::filesystem;

namespace {

constexpr double pixels_of_view = 320.0 * 180.0;

/// A rectangle of `extent` (m) in the plane z = `z`, which faces +z, and whose lower left corner is `corner`. An
/// orthographic camera looks at it along -z: 16 m x 9 m of the plane are 320 x 180 pixels, of 0.05 m each.
void add_rectangle(Scene& scene, glm::vec2 corner, glm::vec2 extent, float z, unsigned material, int parent = -1) {
    Mesh mesh{.name = "rectangle", .material = material};
    for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
        mesh.vertices.push_back({.position = glm::vec3(corner + at * extent, z),
                                 .normal = {0, 0, 1},
                                 .tangent = {1, 0, 0, 1},
                                 .uv = {},
                                 .color = glm::vec4(1)});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.nodes.push_back({.name = "node_" + std::to_string(scene.nodes.size()), .parent = parent});
    scene.instances.push_back({unsigned(scene.meshes.size()), unsigned(scene.nodes.size()) - 1});
    scene.meshes.push_back(std::move(mesh));
}

Scene empty_scene(std::vector<std::string> materials) {
    Scene scene{.name = "wall"};
    for (std::string& name : materials)
        scene.materials.push_back({.name = std::move(name), .base_color = {0.2f, 0.4f, 0.6f}, .metalness = 0});
    scene.cameras.push_back({.name = "front",
                             .is_orthographic = true,
                             .orthographic_height = 9,
                             .near = 0,
                             .far = 20,
                             .keys = {{.position = {0, 0, 10}, .target = {0, 0, 0}}}});
    return scene;
}

std::string blended(const std::string& name) {
    return "The material '" + name + "' is blended (alphaMode BLEND) and drawn opaque.";
}

}  // namespace

/// 4 m x 3 m are 80 x 60 pixels, of which a nearer rectangle hides 20 x 20.
TEST(SceneWarnings, HaveTheShareOfTheFirstViewThatShowsWhatTheyConcern) {
    Scene scene = empty_scene({"glass", "wood", "below", "unseen"});
    add_rectangle(scene, {-2, -1}, {4, 3}, 0, 0);
    add_rectangle(scene, {-2, -1}, {1, 1}, 1, 1);
    add_rectangle(scene, {-5, -1}, {1, 1}, 0.5f, 2, 1);  // below node 1
    add_rectangle(scene, {-2, -1}, {1, 1}, -1, 3);       // behind the others
    scene.nodes.push_back({.name = "lamp"});
    scene.warnings = {
        {blended("glass"), 0},           {"The node 'node_1' is odd.", -1, 1}, {blended("below"), 2},
        {"The extension X is ignored."}, {"The node 'lamp' is dark.", -1, 4},  {"The material 'unseen' is odd.", 3}};
    const ShownWarnings shown = shown_warnings(scene, 9);
    ASSERT_EQ(shown.all.size(), 6u);
    EXPECT_NEAR(shown.all[0].share.value(), (80 * 60 - 400) / pixels_of_view, 1e-9);
    EXPECT_NEAR(shown.all[1].share.value(), 800 / pixels_of_view, 1e-9);
    EXPECT_NEAR(shown.all[2].share.value(), 400 / pixels_of_view, 1e-9);
    EXPECT_FALSE(shown.all[3].share) << "it concerns nothing in particular";
    EXPECT_FALSE(shown.all[4].share) << "it draws nothing";
    EXPECT_EQ(shown.all[5].share.value(), 0);
    EXPECT_EQ(shown.sentences,
              (std::vector<std::string>{
                  "The material 'glass' is blended (alphaMode BLEND) and drawn opaque; the same holds for the material "
                  "'below' (together 8.33 % of the first view's pixels).",
                  "The node 'node_1' is odd (1.39 % of the first view's pixels).", "The extension X is ignored.",
                  "The node 'lamp' is dark.", "The material 'unseen' is odd (not in the first view)."}));
}

/// A perspective camera within what it sees: a floor from behind it to far off, walls that are cut by both planes, one
/// of them mirrored, and one that is seen from behind.
TEST(SceneWarnings, HaveTheSharesThatRaysFind) {
    Scene scene = empty_scene({"floor", "wall", "mirrored", "from behind"});
    scene.draws_backs = false;
    scene.cameras = {{.name = "eye",
                      .vertical_fov = 1.2f,
                      .near = 0.5f,
                      .far = 12,
                      .keys = {{.position = {0.3f, 1, 2}, .target = {0, 0.6f, -3}}}}};
    add_rectangle(scene, {-20, -20}, {40, 40}, 0, 0);
    add_rectangle(scene, {0.5f, 0}, {3, 3}, -4, 1);
    add_rectangle(scene, {0.5f, 0}, {3, 3}, -7, 2);
    add_rectangle(scene, {-4, 0}, {3, 3}, 2, 3);
    scene.nodes[0].parent_from_node = glm::mat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1});  // lies down
    scene.nodes[2].parent_from_node = glm::mat4({-1, 0, 0, 0}, {0, 1, 0, 0}, {0.8f, 0, 1, 0}, {0, 0, 0, 1});
    scene.nodes[3].parent_from_node = glm::mat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, 1});
    for (int i = 0; i < 4; ++i) scene.warnings.push_back({"warning", i});
    const FirstView view = first_view(scene);
    const HostImage rays = traced_first_view(scene, view).material;
    const ShownWarnings shown = shown_warnings(scene, 9);
    for (size_t material = 0; material < 4; ++material) {
        const double share = double(std::ranges::count(rays.values, float(material + 1))) / pixels_of_view;
        EXPECT_NEAR(shown.all[material].share.value(), share, 4 / pixels_of_view) << material;  // pixels of edges
        EXPECT_EQ(share > 0.01, material < 3) << material;
    }
}

TEST(SceneWarnings, OfOneKindAreOneSentenceThatNamesWhatIsSeenMostFirst) {
    Scene scene = empty_scene({});
    for (int i = 0; i < 12; ++i) {
        scene.materials.push_back({.name = "m" + std::to_string(i)});
        scene.warnings.push_back({blended(scene.materials.back().name), i});
    }
    add_rectangle(scene, {0, 0}, {1, 1}, 0, 7);
    EXPECT_EQ(warning_sentences(scene),
              (std::vector<std::string>{"The material 'm7' is blended (alphaMode BLEND) and drawn opaque; the same "
                                        "holds for the materials 'm0', 'm1' and 9 more (together 0.694 % of the first "
                                        "view's pixels)."}));
    scene.warnings.clear();
    for (int i = 0; i < 30; ++i) scene.warnings.push_back({"Extension " + std::to_string(i) + " is ignored."});
    const std::vector<std::string> bounded = warning_sentences(scene);
    ASSERT_EQ(bounded.size(), 20u);
    EXPECT_EQ(bounded.back(), "11 further warnings: `ssrlab inspect --all` lists them.");
}

TEST(Inspect, DescribesAScene) {
    Scene scene = empty_scene({"wall", "not drawn"});
    add_rectangle(scene, {-2, -1}, {4, 3}, 0.5f, 0);
    scene.textures.push_back({.name = "grain.png",
                              .extent = {8, 4},
                              .rgba = make_texels(std::vector<uint8_t>(256)),
                              .channel_bytes = 2,
                              .wrap_u = TextureWrap::clamp_to_edge});
    scene.materials[0].normal_texture.texture = 0;
    scene.cameras.push_back({.name = "eye",
                             .vertical_fov = glm::radians(60.0f),
                             .aspect = 2,
                             .near = 0.1f,
                             .far = 50,
                             .keys = {{}},
                             .frame_count = 7});
    scene.lights.push_back({.name = "sun", .type = LightType::directional, .intensity = {683, 683, 683}});
    scene.lights.push_back({.name = "lamp",
                            .type = LightType::spot,
                            .intensity = {1, 2, 3},
                            .range = 5,
                            .outer_cone_cos = std::cos(glm::radians(30.0f))});
    scene.environment = {.type = Environment::Type::image, .latlong = HostImage({4, 2}, 3, 0.5f)};
    scene.environment.latlong.set_rgb(3, glm::vec3(4.5f));
    scene.clips = {{.name = "walk", .is_played = true}, {.name = "run"}};
    scene.animation = {{.property = AnimationChannel::Property::weight, .times = {0, 1.5f}, .values = {{}, {}}}};
    scene.skins = {{.joints = {0, 0, 0}}};
    scene.meshes[0].targets.resize(1);
    scene.nodes[0].weights = {0};
    const Description d = describe_scene(scene);
    EXPECT_EQ(d["animation"]["weights"], 1);
    EXPECT_EQ(d["animation"]["seconds"], 1.5);
    EXPECT_EQ(d["skins"][0]["joints"], 3);
    EXPECT_EQ(d["bounds"]["low"], (Description{-2.0, -1.0, 0.5}));
    EXPECT_EQ(d["bounds"]["high"], (Description{2.0, 2.0, 0.5}));
    EXPECT_EQ(d["triangles"], 2);
    EXPECT_EQ(d["cameras"][0]["height"], 9.0);
    EXPECT_NEAR(d["cameras"][1]["vertical_fov"].get<double>(), 60, 1e-4);
    EXPECT_EQ(d["cameras"][1]["frames"], 7);
    EXPECT_EQ(d["cameras"][1]["far"], 50.0);
    EXPECT_EQ(d["lights"][0]["irradiance"][0], 683.0);
    EXPECT_EQ(d["lights"][0]["unit"], "W m^-2");
    EXPECT_NEAR(d["lights"][1]["outer_cone"].get<double>(), 30, 1e-3);
    EXPECT_EQ(d["environment"]["largest"], 4.5);
    EXPECT_EQ(d["environment"]["mean"][0], 1.0);  // (7 * 0.5 + 4.5) / 8
    EXPECT_EQ(d["materials"][0]["textures"]["normal"]["texture"], 0);
    EXPECT_EQ(d["materials"][1]["triangles"], 0);
    EXPECT_EQ(d["textures"][0]["bits"], 16);
    EXPECT_EQ(d["textures"][0]["wrap_u"], "clamp_to_edge");

    const std::string page = page_of(d, false);
    for (const char* part :
         {"4 x 3 x 0 m, from (-2, -1, 0.5) to (2, 2, 0.5)", "perspective, 60 degrees high", "planes 0.1 to 50 m",
          "683 W m^-2", "(1, 2, 3) W sr^-1", "cone 0 to 30 degrees",
          "8 x 4, 16 bits, linear, clamp_to_edge and repeat, bilinear", "normal:0", "range 5 m", "walk  played",
          "run   not played", "1 morph weight", "3 joints", "1 mesh part with morph targets"})
        EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
}

/// A page stays a page, and --all lists all; names show as text only.
TEST(Inspect, CutsLongListsWithACount) {
    Scene scene = empty_scene({});
    for (int i = 0; i < 100; ++i) scene.materials.push_back({.name = "\x1b[31m" + std::to_string(i)});
    const Description d = describe_scene(scene);
    const std::string page = page_of(d, false), all = page_of(d, true);
    EXPECT_LE(std::ranges::count(page, '\n'), 60);
    EXPECT_NE(page.find("and 92 more; --all lists them"), std::string::npos) << page;
    EXPECT_GE(std::ranges::count(all, '\n'), 100);
    EXPECT_EQ(all.find('\x1b'), std::string::npos);
}

struct InspectFiles : testing::Test {
    fs::path folder = fs::temp_directory_path() / "inspect_test";
    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    Description description_of(const std::string& name) { return inspect((folder / name).string(), {}).description; }
};

TEST_F(InspectFiles, DescribesChannelsOfImages) {
    LayeredImage image{
        .layers = {{.name = "", .channel_names = "RGB", .image = HostImage({4, 2}, 3, 0.25f)},
                   {.name = "id", .channel_names = "Y", .image = HostImage({4, 2}, 1, 3), .type = PixelType::uint32}}};
    std::vector<float>& values = image.layers[0].image.values;
    values[0] = 8.25f, values[3] = -1.75f, values[1] = std::numeric_limits<float>::quiet_NaN();
    values[2] = -std::numeric_limits<float>::infinity();
    write_exr(folder / "image.exr", image);
    fs::rename(folder / "image.exr", folder / "image.tmp");  // what it is its bytes say
    const Description d = description_of("image.tmp");
    EXPECT_EQ(d["format"], "OpenEXR");
    EXPECT_EQ(d["width"], 4);
    EXPECT_EQ(d["height"], 2);
    const Description& channels = d["channels"];
    EXPECT_EQ(channels[2]["name"], "R");  // in the file's order, which is the alphabet's
    EXPECT_EQ(channels[2]["least"], -1.75);
    EXPECT_EQ(channels[2]["largest"], 8.25);
    EXPECT_EQ(channels[2]["mean"], 1.0);  // (6 * 0.25 + 8.25 - 1.75) / 8
    EXPECT_EQ(channels[2]["nan"], 0);
    EXPECT_EQ(channels[1]["nan"], 1);
    EXPECT_EQ(channels[0]["infinite"], 1);
    EXPECT_EQ(channels[0]["mean"], 0.25);
    EXPECT_EQ(channels[3]["type"], "uint32");
    const std::string page = page_of(d, false);
    EXPECT_NE(page.find("OpenEXR image of 4 x 2 pixels"), std::string::npos) << page;
    EXPECT_NE(page.find("-1.75 to 8.25"), std::string::npos) << page;
    EXPECT_NE(page.find("1 NaN"), std::string::npos) << page;

    HostImage white({3, 5}, 3, 1.0f);
    white.set_rgb(0, glm::vec3(0));
    write_png(folder / "white.png", white);
    const Description png = description_of("white.png");
    EXPECT_EQ(png["format"], "PNG");
    EXPECT_EQ(png["height"], 5);
    EXPECT_EQ(png["stored"], "8 bits, RGB");
    EXPECT_NEAR(png["channels"][1]["mean"].get<double>(), 14.0 / 15.0, 1e-6);
}

/// 4 x 2 of 8 x 4 pixels are stored, in Rec. 2020, beside a channel that is no colour; and what is left where pixels
/// lack.
TEST_F(InspectFiles, DescribesWindowsPrimariesAndThePictureOfOpenExr) {
    Imf::Header header(Imath::Box2i({0, 0}, {7, 3}), Imath::Box2i({2, 1}, {5, 2}));
    Imf::addChromaticities(header,
                           Imf::Chromaticities({0.708f, 0.292f}, {0.17f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.329f}));
    const std::vector<float> ones(8, 1.0f);
    Imf::FrameBuffer frame;
    for (const char* name : {"beauty.R", "beauty.G", "beauty.B", "AO"}) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        frame.insert(
            name,
            Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(ones.data())) - (2 + 4) * 4, 4, 4 * 4));
    }
    {
        Imf::OutputFile out((folder / "windows.exr").c_str(), header);
        out.setFrameBuffer(frame);
        out.writePixels(2);
    }
    const Description d = description_of("windows.exr");
    EXPECT_EQ(d["width"], 8);
    EXPECT_EQ(d["parts"][0]["data_window"], (Description{2, 1, 5, 2}));
    EXPECT_EQ(d["parts"][0]["primaries"], "Rec. 2020");
    EXPECT_EQ(d["picture"]["channels"], (Description{"beauty.R", "beauty.G", "beauty.B"}));
    EXPECT_EQ(d["picture"]["colors"], "linear Rec. 709, converted from Rec. 2020");
    EXPECT_EQ(d["channels"].size(), 4u);
    EXPECT_EQ(d["channels"][0]["mean"], 0.25);  // 8 ones of 32 pixels
    EXPECT_NE(page_of(d, false).find("holds pixels 2 to 5, 1 to 2 of the picture's 0 to 7, 0 to 3"), std::string::npos)
        << page_of(d, false);

    fs::resize_file(folder / "windows.exr", fs::file_size(folder / "windows.exr") - 20);
    const Inspected cut = inspect((folder / "windows.exr").string(), {});
    EXPECT_NE(cut.refusal.find("windows.exr"), std::string::npos);
    EXPECT_EQ(cut.description["channels"][3]["name"], "beauty.R");
    EXPECT_FALSE(cut.description["channels"][3].contains("mean"));
    EXPECT_FALSE(page_of(cut.description, false).empty());
}

/// Of a file that cannot be used it still says what the file is.
TEST_F(InspectFiles, DescribesWhatIsRefused) {
    write_text(folder / "odd.gltf", R"({"asset": {"version": "2.0", "generator": "Some exporter"}, "meshes": [{}, {}],
        "extensionsUsed": ["VENDOR_a", 3], "extensionsRequired": ["VENDOR_a"], "nodes": 7})");
    const Inspected odd = inspect((folder / "odd.gltf").string(), {});
    EXPECT_FALSE(odd.scene);
    EXPECT_NE(odd.refusal.find("odd.gltf"), std::string::npos);
    EXPECT_EQ(odd.description["document"]["counts"], (Description{{"meshes", 2}}));
    EXPECT_EQ(odd.description["document"]["extensions_used"], Description::array({"VENDOR_a"}));
    const std::string page = page_of(odd.description, false);
    for (const char* part :
         {"a scene that ssrlab cannot use", "glTF 2.0 by Some exporter", "required    VENDOR_a", "2 meshes"})
        EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
    for (const char* text : {"{", "[1, 2]", "no glTF"}) {
        write_text(folder / "broken.gltf", text);
        EXPECT_THROW(inspect((folder / "broken.gltf").string(), {}), Error) << text;
    }
}

TEST_F(InspectFiles, HintNamesFilesThatAreThere) {
    write_exr(folder / "my a.EXR", HostImage({1, 1}, 3));
    const std::string file = (folder / "my a.EXR").string();
    const std::string hint = "`ssrlab inspect '" + file + "'` shows what ssrlab understands of the file";
    for (const std::string& message : {file + ": has no layer 'x'", "cannot read " + file + " as OpenEXR: cut",
                                       "two images: '" + file + "' and b.exr differ", file + " is 1 x 1"})
        EXPECT_EQ(inspect_hint(message), hint) << message;
    for (const std::string& message :
         {folder.string() + "/b.exr: no such file", std::string("study.json:2: 'a.exrs'"), file + "ray: no such file"})
        EXPECT_EQ(inspect_hint(message), "") << message;
}

/// Pixels that the rectangle covers differ where a renderer is broken on purpose, and none else.
TEST(InspectPicture, ShowsWhereTheRenderersDiffer) {
    Scene scene = empty_scene({"wall", "other"});
    add_rectangle(scene, {-2, -1}, {4, 3}, 0, 0);
    add_rectangle(scene, {-7, -4}, {14, 1}, -1, 1);
    scene.materials[1].emission = glm::vec3(3, 2, 1);
    Device device("");
    const FirstView view = first_view(scene);
    const FirstViewImages traced = traced_first_view(scene, view);
    const FirstViewDifference none = difference_of(rasterised_first_view(device, scene, view), traced);
    EXPECT_EQ(none.pixels(), 0u);
    EXPECT_EQ(none.differs.size(), size_t(pixels_of_view));

    Scene broken = scene;
    broken.materials[0].base_color.g += 0.1f;
    const FirstViewDifference colors = difference_of(rasterised_first_view(device, broken, view), traced);
    EXPECT_EQ(colors.colors, 80u * 60u);
    EXPECT_EQ(colors.pixels(), 80u * 60u);
    for (Vertex& vertex : broken.meshes[1].vertices) vertex.normal = glm::normalize(glm::vec3(0, 0.1f, 1));
    broken.instances.erase(broken.instances.begin());
    const FirstViewDifference rest = difference_of(rasterised_first_view(device, broken, view), traced);
    EXPECT_EQ(rest.surfaces, 80u * 60u);
    EXPECT_EQ(rest.normals, 280u * 20u);
    const HostImage picture = picture_of(traced, traced, rest, 0);
    EXPECT_EQ(picture.extent, glm::uvec2(3 * 320 + 8, 3 * 180 + 8));
    EXPECT_EQ(picture.rgb(size_t(90) * picture.extent.x + 2 * 324 + 160), glm::vec3(1, 0, 0)) << "a surface is missing";
}
