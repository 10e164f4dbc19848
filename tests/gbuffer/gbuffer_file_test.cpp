#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/gbuffer/camera_file.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/json.h"
#include "tests/gbuffer/test_scenes.h"

#include <gtest/gtest.h>
#include <cstring>
#include <set>

namespace {

class gbuffer_file : public testing::Test {
protected:
    gbuffer_file() : folder_(std::filesystem::temp_directory_path() / "gbuffer_file") {
        std::filesystem::remove_all(folder_);
    }
    ~gbuffer_file() override { std::filesystem::remove_all(folder_); }

    std::string load_error() const {
        try {
            load_gbuffer(folder_);
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    }

    std::filesystem::path folder_;
};

HostGBuffer rendered(unsigned frame) {
    const Scene scene = varied_scene();
    const glm::uvec2 extent(37, 23);
    Rasterizer rasterizer(test_device(), scene, {.extent = extent, .depth_format = DepthFormat::d16});
    FrameView view = view_of(extent, frame, DepthDirection::reversed);
    view.seed = 77;
    view.jitter = {0.123f, -0.4f};
    view.previous_jitter = {-0.1f, 0.3f};
    const GBuffer gbuffer = rasterizer.render(scene.camera("main"), view);
    rasterizer.light_directly(gbuffer);
    return download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), DepthFormat::d16);
}

void expect_same_bits(const HostGBuffer& a, const HostGBuffer& b) {
    for (const auto image :
         {&HostGBuffer::depth, &HostGBuffer::geometric_normal, &HostGBuffer::normal, &HostGBuffer::base_color,
          &HostGBuffer::emission, &HostGBuffer::motion, &HostGBuffer::material_id, &HostGBuffer::previous_depth,
          &HostGBuffer::previous_normal, &HostGBuffer::lit, &HostGBuffer::fallback})
        EXPECT_EQ(differing_bits(a.*image, b.*image), 0u);
    EXPECT_EQ(std::memcmp(&a.camera, &b.camera, sizeof a.camera), 0);
    EXPECT_EQ(a.depth_format, b.depth_format);
}

}  // namespace

TEST_F(gbuffer_file, comes_back_bit_by_bit) {
    for (const unsigned frame : {0u, 6u}) {
        const HostGBuffer before = rendered(frame);
        ASSERT_GT(*std::ranges::max_element(before.material_id.values), 3.0f);
        save_gbuffer(folder_, before);
        const LoadedGBuffer loaded = load_gbuffer(folder_);
        EXPECT_EQ(loaded.notes, std::vector<std::string>{});
        EXPECT_TRUE(loaded.absent.empty());
        PassList pass_list(test_device(), loaded.gbuffer.extent());
        const GBuffer uploaded = upload_gbuffer(pass_list, loaded.gbuffer);
        expect_same_bits(download_gbuffer(pass_list, uploaded, loaded.gbuffer.camera, loaded.gbuffer.depth_format),
                         before);
    }
}

TEST_F(gbuffer_file, a_capture_of_another_engine_may_leave_out_the_optional) {
    const HostGBuffer g = rendered(0);
    save_gbuffer(folder_, g);
    LayeredImage file = read_exr(folder_ / "gbuffer.exr");
    const std::vector<std::string> required{"depth", "normal", "roughness", "base_color", "metalness"};
    std::erase_if(file.layers,
                  [&](const Layer& layer) { return std::ranges::find(required, layer.name) == required.end(); });
    file.layers.push_back({"beauty", "RGB", HostImage(g.extent(), 3, 1)});
    write_exr(folder_ / "gbuffer.exr", file);
    nlohmann::json camera = read_json(folder_ / "camera.json");
    for (const char* key : {"view_from_clip", "world_from_view", "clip_from_world", "world_from_clip", "frame", "seed",
                            "jitter", "previous_jitter", "is_orthographic"})
        camera.erase(key);
    write_text(folder_ / "camera.json", camera.dump());

    const LoadedGBuffer loaded = load_gbuffer(folder_);
    EXPECT_EQ(loaded.absent.size(), 10u);
    EXPECT_EQ(loaded.notes.size(), 1u);  // one layer is not used
    EXPECT_TRUE(loaded.gbuffer.lit.values.empty());
    EXPECT_EQ(differing_bits(loaded.gbuffer.previous_normal, g.normal), 0u);
    for (size_t i = 0; i < g.depth.pixel_count(); ++i) {
        ASSERT_EQ(loaded.gbuffer.geometric_normal.rgb(i), g.normal.rgb(i));
        ASSERT_EQ(loaded.gbuffer.emission.values[4 * i + 3], g.depth.values[i] == 0 ? 0 : 1);
    }
    const CameraData& derived = loaded.gbuffer.camera;
    for (const glm::mat4& product :
         {derived.view_from_clip * g.camera.clip_from_view, derived.world_from_clip * g.camera.clip_from_world})
        for (int i = 0; i < 4; ++i)
            EXPECT_NEAR(glm::length(product[i] - glm::mat4(1)[i]), 0, 1e-4f);  // a float32 inverse
}

TEST_F(gbuffer_file, camera_json_has_the_keys_that_writers_are_told) {
    save_gbuffer(folder_, rendered(6));
    std::set<std::string> written, told;
    const nlohmann::json camera = read_json(folder_ / "camera.json");
    for (const auto& [key, value] : camera.items()) written.insert(key);
    for (const CameraFileKey& key : camera_file_keys()) told.insert(key.name);
    EXPECT_EQ(told, written);
}

TEST_F(gbuffer_file, needs_the_keys_that_writers_are_told_are_required) {
    save_gbuffer(folder_, rendered(0));
    const nlohmann::json whole = read_json(folder_ / "camera.json");
    for (const CameraFileKey& key : camera_file_keys()) {
        nlohmann::json without = whole;
        if (!without.erase(key.name)) continue;
        write_text(folder_ / "camera.json", without.dump());
        EXPECT_EQ(load_error().find(key.name) != std::string::npos, *key.initial == 0) << key.name << load_error();
    }
}

TEST_F(gbuffer_file, errors_name_file_and_layer) {
    save_gbuffer(folder_, rendered(0));
    LayeredImage file = read_exr(folder_ / "gbuffer.exr");
    for (Layer& layer : file.layers)
        if (layer.name == "roughness") layer.name = "rougness";
    write_exr(folder_ / "gbuffer.exr", file);
    EXPECT_NE(load_error().find("lacks the layer 'roughness', but has 'rougness'"), std::string::npos) << load_error();

    nlohmann::json camera = read_json(folder_ / "camera.json");
    const nlohmann::json whole = camera;
    camera["extent"] = {36, 23};
    write_text(folder_ / "camera.json", camera.dump());
    EXPECT_NE(load_error().find("camera.json says 36 x 23"), std::string::npos) << load_error();
    camera["extent"] = {0, 23};
    write_text(folder_ / "camera.json", camera.dump());
    EXPECT_NE(load_error().find("'extent' holds 0"), std::string::npos) << load_error();
    camera = whole;
    camera["clip_from_view"] = {1, 2};
    write_text(folder_ / "camera.json", camera.dump());
    EXPECT_NE(load_error().find("four rows"), std::string::npos) << load_error();
    camera = whole;
    camera["depth_directon"] = "standard";
    write_text(folder_ / "camera.json", camera.dump());
    EXPECT_NE(load_error().find("depth_directon"), std::string::npos) << load_error();

    for (const auto& [key, value] :
         {std::pair<const char*, nlohmann::json>("jitter", {1e39, 0}),
          {"previous_jitter", {0, 1e30}},
          {"near", 1e39},
          {"far", 1e39},
          {"clip_from_world", {{1, 0, 0, 0}, {0, 1, 0, 1e39}, {0, 0, 1, 0}, {0, 0, 0, 1}}}}) {
        camera = whole;
        camera[key] = value;
        write_text(folder_ / "camera.json", camera.dump());
        EXPECT_NE(load_error().find("camera.json: '" + std::string(key) + "'"), std::string::npos) << load_error();
    }
    const nlohmann::json zeros(4, nlohmann::json(4, 0)), rows = whole["world_from_view"];
    const nlohmann::json other = {rows[1], rows[0], rows[2], rows[3]};
    for (const char* key : {"clip_from_view", "view_from_world"}) {
        camera = whole;
        camera[key] = zeros;
        write_text(folder_ / "camera.json", camera.dump());
        EXPECT_NE(load_error().find("'" + std::string(key) + "' has determinant 0"), std::string::npos) << load_error();
    }
    for (const char* key : {"view_from_clip", "world_from_view", "clip_from_world", "world_from_clip",
                            "previous_view_from_clip", "previous_world_from_view", "previous_clip_from_world"})
        for (const nlohmann::json& matrix : {zeros, other}) {
            camera = whole;
            camera[key] = matrix;
            write_text(folder_ / "camera.json", camera.dump());
            EXPECT_NE(load_error().find("camera.json: '" + std::string(key) + "' contradicts"), std::string::npos)
                << load_error();
        }
    camera = whole;
    camera["is_orthographic"] = true;
    write_text(folder_ / "camera.json", camera.dump());
    EXPECT_NE(load_error().find("'is_orthographic' is true, but the last row"), std::string::npos) << load_error();

    camera = whole;  // in range each, not so their product
    for (const char* key : {"view_from_clip", "world_from_view", "clip_from_world", "world_from_clip"})
        camera.erase(key);
    camera["clip_from_view"][0][0] = 1e30, camera["view_from_world"][0][0] = 1e30;
    write_text(folder_ / "camera.json", camera.dump());
    EXPECT_NE(load_error().find("'clip_from_view' and 'view_from_world'"), std::string::npos) << load_error();

    std::filesystem::remove(folder_ / "camera.json");
    EXPECT_NE(load_error().find("camera.json"), std::string::npos);
}
