// What `ssrlab scene-for` writes: the geometry and the materials that the scene draws, and the light that images of
// other programs are compared with.
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gbuffer/rasterizer.h"
#include "core/gpu/device.h"
#include "core/json.h"
#include "core/scene/load_scene.h"
#include "experiments/bridges/scene_for/raw_files.h"
#include "experiments/bridges/scene_for/scene_folder.h"
#include "experiments/bridges/scene_for/scene_glb.h"
#include "tests/error_message.h"
#include "tests/experiments/study/external_fixture.h"

#include <algorithm>
#include <cstring>

namespace {

const glm::uvec2 extent(96, 54);

std::vector<fs::path> own_scenes() { return {fs::path(SSRLAB_SOURCE_DIR) / "scenes"}; }

struct SceneForTest : StudyTest {
    static constexpr unsigned samples = 64;

    SceneFolderSettings settings(const std::string& scene, const std::string& engine = "three") {
        const auto& engines = scene_engines();
        return {.engine = *std::ranges::find(engines, engine, &SceneEngine::name),
                .scene = scene,
                .cameras = {},
                .extent = extent,
                .frames = {0},
                .reference = {.max_samples = samples},
                .out = folder / "scene",
                .cache = folder / "cache",
                .search_path = own_scenes(),
                .say = [](const std::string&) {},
                .report = [](double, const std::string&) {}};
    }
    HostGBuffer drawn(const Scene& scene, const SceneCamera& camera, unsigned frame) {
        Rasterizer rasterizer(device(), scene, {.extent = extent});
        const GBuffer gbuffer = rasterizer.render(camera, {.extent = extent, .frame = frame, .index = 0u});
        return download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), DepthFormat::d32f);
    }
    static Device& device() {
        static Device device;
        return device;
    }
};

bool has_same_bits(const HostImage& a, const HostImage& b) {
    return a.extent == b.extent && a.values.size() == b.values.size() &&
           std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)) == 0;
}

float largest_difference(const HostImage& a, const HostImage& b) {
    float largest = 0;
    for (size_t i = 0; i < a.values.size(); ++i) largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
    return largest;
}

size_t first_instance(const Scene& scene, size_t mesh) {
    return size_t(std::ranges::find(scene.instances, unsigned(mesh), &Instance::mesh) - scene.instances.begin());
}

}  // namespace

/// Moving nodes, textures with normal maps, many materials.
TEST_F(SceneForTest, GlbIsDrawnAsTheSceneIs) {
    for (const auto& [name, frame] :
         {std::pair("moving_objects", 7u), {"normal_mapped", 0u}, {"roughness_gradient", 0u}}) {
        const Scene scene = load_scene(name, own_scenes());
        const SceneCamera& camera = scene.cameras.front();
        ASSERT_EQ(camera.keys.size(), 1u) << "the same in all frames";
        const ScenePose pose = pose_scene(scene, float(frame));
        const fs::path file = folder / (std::string(name) + ".glb");
        write_scene_glb(file, scene, pose,
                        {{.lens = camera,
                          .world_from_camera = pose_camera(camera, pose, float(frame)).world_from_view,
                          .aspect = 16.0f / 9}});
        const Scene read = load_scene(file.string(), {});
        EXPECT_TRUE(read.warnings.empty());
        ASSERT_EQ(read.cameras.size(), 1u);
        EXPECT_EQ(read.cameras[0].name, camera.name);
        EXPECT_EQ(read.cameras[0].vertical_fov, camera.vertical_fov);
        ASSERT_EQ(read.instances.size(), scene.instances.size());
        EXPECT_EQ(pose_scene(read, 0).world_from_instance, pose.world_from_instance) << name;
        for (size_t m = 0; m < scene.meshes.size(); ++m) {
            const Mesh &of_scene = scene.meshes[m],
                       &of_file = read.meshes[read.instances[first_instance(scene, m)].mesh];
            EXPECT_EQ(of_file.indices, of_scene.indices);
            ASSERT_EQ(of_file.vertices.size(), of_scene.vertices.size());
            for (size_t i = 0; i < of_scene.vertices.size(); ++i) {
                EXPECT_EQ(of_file.vertices[i].position, of_scene.vertices[i].position);
                EXPECT_LT(glm::distance(of_file.vertices[i].normal, of_scene.vertices[i].normal), 2e-7f);
            }
        }

        const HostGBuffer of_scene = drawn(scene, camera, frame), of_glb = drawn(read, camera, 0);
        EXPECT_TRUE(has_same_bits(of_scene.depth, of_glb.depth)) << name;
        EXPECT_TRUE(has_same_bits(of_scene.geometric_normal, of_glb.geometric_normal)) << name;
        // Reading makes normals of unit length again, to the last bit or the one before; the rasteriser does, too, by
        // a reciprocal square root of 22 bits.
        EXPECT_LT(largest_difference(of_scene.normal, of_glb.normal), 4e-6f) << name << ", with roughness";
        EXPECT_TRUE(has_same_bits(of_scene.base_color, of_glb.base_color)) << name << ", with metalness";
        EXPECT_TRUE(has_same_bits(of_scene.material_id, of_glb.material_id)) << name;
        // A factor times a strength: half an ulp each, of radiances up to 16.
        EXPECT_LT(largest_difference(of_scene.emission, of_glb.emission), 4e-6f) << name;
    }
}

/// As external images whose reflections are missing: that the proof finds no pixel that differs, that nothing is
/// traced again, and that the error is that of no reflections at all, since mirror_pillars has no light to fall back to
/// but a constant one.
TEST_F(SceneForTest, LightIsThatOfAStudyAndItsProof) {
    const SceneFolder written = write_scene_folder(settings("mirror_pillars"));
    EXPECT_EQ(written.rendered, 1u);
    const nlohmann::json scene = read_json(folder / "scene/scene.json");
    ASSERT_EQ(scene["views"].size(), 1u);
    const std::string view = scene["views"][0]["view"];
    EXPECT_EQ(view, "mirror_pillars.main.96x54");
    EXPECT_FALSE(scene["views"][0]["frames"][0].contains("light_halves")) << "it shines by itself, without noise";
    const HostImage light = read_exr_rgb(folder / "scene" / scene["views"][0]["frames"][0]["light"].get<std::string>());
    write_exr(folder / "frames" / view / "f0.off.exr", light);
    write_exr(folder / "frames" / view / "f0.s0.exr", light);
    describe_frames(folder / "frames");
    write_text(folder / "study.json",
               R"({"shots": [{"scene": "mirror_pillars", "resolution": [96, 54]}], "reference": {"samples": 64},
            "techniques": [{"external": "frames"}], "metrics": ["mse"], "masks": ["all"], "timing": {"frames": 0}})");
    const fs::path out = run(read_config(folder / "study.json"), "out");
    const nlohmann::json manifest = read_json(out / "manifest.json");
    EXPECT_NE(manifest.dump().find(" pixels of background and emission 0 differ from the truth\""), std::string::npos);
    EXPECT_EQ(write_scene_folder(settings("mirror_pillars")).cached, 1u);
    for (const auto& row : read_rows<ResultRow>(out / "results.csv")) EXPECT_GT(row.value.value(), 0.0);
}

/// A program that adds the same everywhere reflects no noise; one that reflects half of it has a quarter of the squared
/// error that all of it would make, which is what an image without halves is held to have.
TEST_F(SceneForTest, HalvesOfTheLightShowWhatItsNoiseDoesToReflections) {
    write_scene_folder(settings("normal_mapped"));
    const nlohmann::json view = read_json(folder / "scene/scene.json")["views"][0], &frame = view["frames"][0];
    ASSERT_TRUE(frame.contains("light_halves"));
    const auto of_scene = [&](const nlohmann::json& file) {
        return read_exr_rgb(folder / "scene" / file.get<std::string>());
    };
    const HostImage light = of_scene(frame["light"]), a = of_scene(frame["light_halves"][0]),
                    b = of_scene(frame["light_halves"][1]);
    for (size_t i = 0; i < light.values.size(); ++i)
        ASSERT_NEAR(0.5f * (a.values[i] + b.values[i]), light.values[i], 1e-5f * light.values[i]);
    const auto write = [&](const std::string& kind, const HostImage& lit, float added, float of_noise) {
        HostImage image = lit;
        for (size_t i = 0; i < image.values.size(); ++i)
            image.values[i] += added + of_noise * (lit.values[i] - light.values[i]);
        write_exr(folder / "frames" / view["view"].get<std::string>() / ("f0." + kind + ".exr"), image);
    };
    describe_frames(folder / "frames", R"(, "given_light": true)");
    write_text(folder / "study.json",
               R"({"shots": [{"scene": "normal_mapped", "resolution": [96, 54]}], "reference": {"samples": 64},
            "techniques": [{"external": "frames"}], "metrics": ["mse"], "targets": ["specular"], "masks": ["all"], "timing": {"frames": 0}})");
    const auto lit_noise = [&](const std::string& out) {
        const auto rows = read_rows<ResultRow>(run(read_config(folder / "study.json"), out) / "results.csv");
        return rows.at(0).lit_noise.value();
    };
    write("off", light, 0, 0), write("s0", light, 0.1f, 0);
    const double all = lit_noise("without_halves");
    EXPECT_GT(all, 0);
    write("half_a", a, 0.1f, 0), write("half_b", b, 0.1f, 0);
    EXPECT_NEAR(lit_noise("none_reflected"), 0, 1e-6 * all);  // float32
    write("half_a", a, 0.1f, 0.5f), write("half_b", b, 0.1f, 0.5f);
    EXPECT_NEAR(lit_noise("half_reflected"), 0.25 * all, 1e-4 * all);
}

/// What ssrlab's own scenes lack: transforms of textures, their samplers, masks, strengths, lights, orthographic
/// cameras.
TEST_F(SceneForTest, GlbKeepsWhatMaterialsAndLightsSay) {
    Scene scene;
    scene.textures = {{.name = "t",
                       .extent = {2, 1},
                       .rgba = make_texels({1, 2, 3, 255, 4, 5, 6, 128}),
                       .is_srgb = true,
                       .wrap_u = TextureWrap::mirrored_repeat,
                       .wrap_v = TextureWrap::clamp_to_edge,
                       .is_nearest = true}};
    const float c = std::cos(0.7f), s = std::sin(0.7f);
    const glm::mat3 mirrored(2 * c, -2 * s, 0, -3 * s, -3 * c, 0, 0.25f, -1, 1);  // scale (2, -3)
    scene.materials = {{.name = "m",
                        .base_color = {0.1f, 0.2f, 0.3f},
                        .base_color_texture = {.texture = 0, .texcoord = 1, .uv_transform = mirrored},
                        .metalness = 0.6f,
                        .roughness = 0.35f,
                        .emission = {30, 1, 0},
                        .specular = 0.4f,
                        .specular_texture = {.texture = 0},
                        .specular_color = {2, 0.5f, 0},
                        .specular_color_texture = {.texture = 0, .texcoord = 1},
                        .dielectric_f0 = 0.1724f,
                        .alpha_mode = AlphaMode::mask,
                        .alpha_cutoff = 0.7f}};
    const auto corner = [](float x, float y) {
        return Vertex{.position = {x, y, 0},
                      .normal = {0, 0, 1},
                      .tangent = {1, 0, 0, 1},
                      .uv = {{0, 0}, {x, y}},
                      .color = glm::vec4(1)};
    };
    scene.meshes = {{.name = "triangle", .vertices = {corner(0, 0), corner(1, 0), corner(0, 1)}, .indices = {0, 1, 2}}};
    scene.nodes = {{.name = "n"}};
    scene.instances = {{0, 0}};
    scene.lights = {{.type = LightType::spot,
                     .intensity = {4, 2, 0},
                     .range = 9,
                     .inner_cone_cos = std::cos(0.2f),
                     .outer_cone_cos = std::cos(0.5f),
                     .position = {1, 2, 3},
                     .direction = glm::normalize(glm::vec3(1, -2, 0.5f))}};
    const SceneCamera lens{.name = "flat", .is_orthographic = true, .orthographic_height = 3, .near = 0, .far = 9};
    write_scene_glb(folder / "s.glb", scene, pose_scene(scene, 0), {{.lens = lens}});
    const Scene read = load_scene((folder / "s.glb").string(), {});
    EXPECT_TRUE(read.warnings.empty());
    const Texture& texture = read.textures.at(0);
    EXPECT_EQ(*texture.rgba, *scene.textures[0].rgba);
    Scene wide = scene;  // the same bytes as one texel of 16 bits
    wide.textures[0].extent = {1, 1}, wide.textures[0].channel_bytes = 2;
    write_scene_glb(folder / "w.glb", wide, pose_scene(wide, 0), {{.lens = lens}});
    EXPECT_EQ(*load_scene((folder / "w.glb").string(), {}).textures.at(0).rgba, *scene.textures[0].rgba);
    EXPECT_TRUE(texture.is_srgb && texture.is_nearest);
    EXPECT_EQ(texture.wrap_u, TextureWrap::mirrored_repeat);
    EXPECT_EQ(texture.wrap_v, TextureWrap::clamp_to_edge);
    const Material &of_file = read.materials.at(0), &of_scene = scene.materials[0];
    EXPECT_EQ(of_file.base_color, of_scene.base_color);
    EXPECT_EQ(of_file.metalness, of_scene.metalness);
    EXPECT_EQ(of_file.roughness, of_scene.roughness);
    EXPECT_EQ(of_file.specular, of_scene.specular);
    EXPECT_EQ(of_file.specular_color, of_scene.specular_color);
    EXPECT_FLOAT_EQ(of_file.dielectric_f0, of_scene.dielectric_f0);
    EXPECT_GE(of_file.specular_texture.texture, 0);
    EXPECT_EQ(of_file.specular_color_texture.texcoord, 1u);
    EXPECT_EQ(of_file.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(of_file.alpha_cutoff, of_scene.alpha_cutoff);
    EXPECT_EQ(of_file.base_color_texture.texcoord, 1u);
    for (int i = 0; i < 3; ++i) {
        EXPECT_FLOAT_EQ(of_file.emission[i], of_scene.emission[i]);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(of_file.base_color_texture.uv_transform[i][k], mirrored[i][k], 1e-6f) << i << k;
    }
    EXPECT_EQ(read.meshes.at(0).vertices[1].uv[1], glm::vec2(1, 0));
    const PunctualLight light = pose_scene(read, 0).lights.at(0), &own = scene.lights[0];
    EXPECT_EQ(light.type, LightType::spot);
    EXPECT_EQ(light.range, own.range);
    EXPECT_EQ(light.position, own.position);
    EXPECT_LT(glm::distance(light.direction, own.direction), 1e-6f);
    EXPECT_LT(glm::distance(light.intensity, own.intensity), 1e-6f);
    EXPECT_NEAR(light.inner_cone_cos, own.inner_cone_cos, 1e-6f);
    EXPECT_NEAR(light.outer_cone_cos, own.outer_cone_cos, 1e-6f);
    EXPECT_EQ(read.camera("flat").orthographic_height, 3);
}

TEST_F(SceneForTest, DescribesEachViewAndFrame) {
    SceneFolderSettings all = settings("moving_objects", "any");
    all.extent = {32, 18};
    all.frames = {0, 3};
    write_scene_folder(all);
    const nlohmann::json description = read_json(folder / "scene/scene.json");
    const Scene scene = load_scene("moving_objects", own_scenes());
    const std::vector<std::string> names = instance_names(scene);
    const nlohmann::json& view = description["views"][0];
    EXPECT_EQ(view["width"], 32);
    EXPECT_EQ(view["vertical_fov"].get<float>(), scene.cameras[0].vertical_fov);
    ASSERT_EQ(view["frames"].size(), 2u);
    const ScenePose pose = pose_scene(scene, 3);
    const auto& nodes = view["frames"][1]["nodes"];
    ASSERT_EQ(nodes.size(), names.size());
    for (size_t i = 0; i < names.size(); ++i)
        for (int k = 0; k < 16; ++k)
            EXPECT_EQ(nodes[names[i]][size_t(k)].get<float>(), pose.world_from_instance[i][k / 4][k % 4]) << names[i];
    EXPECT_NE(view["frames"][0]["nodes"], nodes) << "something moves";
    // The same values in all formats.
    const nlohmann::json& frame = view["frames"][1];
    const HostImage light = read_exr_rgb(folder / "scene" / frame["light"].get<std::string>());
    const std::string raw = read_text(folder / "scene" / frame["light_raw"].get<std::string>());
    ASSERT_EQ(raw.size(), light.values.size() * sizeof(float));
    EXPECT_EQ(std::memcmp(raw.data(), light.values.data(), raw.size()), 0);
    const nlohmann::json meshes = read_json(folder / "scene/scene.meshes.json");
    EXPECT_EQ(meshes["nodes"].size(), names.size());
    EXPECT_EQ(meshes["meshes"][0]["indices"].get<std::vector<uint32_t>>(), scene.meshes[0].indices);
    EXPECT_EQ(meshes["meshes"][0]["positions"].size(), 3 * scene.meshes[0].vertices.size());
}

/// A gradient is drawn as an image; Radiance's format holds what it shows to 8 bits.
TEST_F(SceneForTest, WritesAnEnvironmentThatIsNoColour) {
    HostImage image({3, 2}, 3);
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = 0.01f * float(i * i);
    write_hdr(folder / "e.hdr", image);
    const std::string hdr = read_text(folder / "e.hdr");
    const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 3\n";
    ASSERT_EQ(hdr.substr(0, head.size()), head);
    ASSERT_EQ(hdr.size(), head.size() + 6 * 4);
    for (size_t i = 0; i < 6; ++i) {
        const auto* code = reinterpret_cast<const uint8_t*>(hdr.data() + head.size() + 4 * i);
        for (size_t c = 0; c < 3; ++c) {
            const float scale = std::ldexp(1.0f, int(code[3]) - 128 - 8), value = image.values[i * 3 + c];
            EXPECT_NEAR(float(code[c]) * scale, value, scale) << i;
        }
    }
}

/// In place of mirror_pillars' constant environment of 0.02.
TEST_F(SceneForTest, AProbeTakesTheEnvironmentsPlace) {
    SceneFolderSettings probed = settings("mirror_pillars");
    probed.extent = {32, 18};
    probed.has_probe = true;
    write_scene_folder(probed);
    const nlohmann::json background = read_json(folder / "scene/scene.json")["background"];
    const HostImage seen = read_exr_rgb(folder / "scene" / background.at("image").get<std::string>());
    EXPECT_GT(std::ranges::max(seen.values), 0.5f) << "pillars emit 1";
    probed.cameras = {"main", "dolly"};
    const std::string why = error_message([&] { write_scene_folder(probed); });
    EXPECT_NE(why.find("a probe is one camera's, and 2 were named"), std::string::npos) << why;
}

TEST_F(SceneForTest, NamesAreUniqueAndPlain) {
    Scene scene;
    scene.nodes = {{.name = "a b"}, {.name = "a.b"}, {.name = ""}, {.name = "a_b_2"}};
    scene.instances = {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 0}};
    EXPECT_EQ(instance_names(scene), (std::vector<std::string>{"a_b", "a_b_2", "node_2", "a_b_2_2", "a_b_3"}));
}

TEST_F(SceneForTest, RefusesWhatIsNotThere) {
    EXPECT_THROW(write_scene_folder(settings("mirror_pilars")), Error);
    SceneFolderSettings other = settings("mirror_pillars");
    other.cameras = {"dolly", "main", "back"};
    EXPECT_THROW(write_scene_folder(other), Error);
    EXPECT_FALSE(fs::exists(folder / "scene")) << "before anything is rendered";
}
