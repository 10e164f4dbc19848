// Techniques that keep to the limits of WebGL 2.
#include "core/error.h"
#include "core/gpu/pipelines/shader.h"
#include "tests/error_message.h"
#include "tests/variants/amd_scenes.h"
#include "tests/variants/technique_fixture.h"

#include <filesystem>

namespace {

std::vector<std::string> fragment_shaders(const std::string& folder) {
    std::vector<std::string> files;
    for (const auto& file : std::filesystem::directory_iterator(SSRLAB_SOURCE_DIR "/variants/" + folder)) {
        EXPECT_NE(file.path().extension(), ".comp") << file.path();
        if (file.path().extension() == ".frag") files.push_back(folder + "/" + file.path().filename().string());
    }
    return files;
}

struct Webgl2Technique : TechniqueTest {
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = {67, 45}};

    /// Frames of a camera that moves sideways, each within `limits`.
    void render(Technique& technique, Limits limits, unsigned count = 3) {
        PassList pass_list(device(), view.extent);
        CameraPose before;
        for (view.frame = 0; view.frame < count; ++view.frame) {
            pose.world_from_view[3].x = 0.05f * float(view.frame);
            const CameraData camera = camera_data(pose, view.frame > 0 ? &before : nullptr, view);
            const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, glossy_floor);
            pass_list.begin_frame(camera, technique.params, gbuffer.images());
            const LimitScope scope(pass_list, limits);
            technique.render(pass_list, gbuffer);
            before = pose;
        }
    }
};

std::vector<std::string> presets_of(const TechniqueEntry& entry) {
    std::vector<std::string> names;
    for (const Preset& preset : entry.presets) names.push_back(preset.name);
    return names;
}

}  // namespace

TEST_F(Webgl2Technique, IsNamedInTheTable) {
    EXPECT_EQ(limits_text(find_technique("diligent_ssr").limits),
              "WebGL 2 with EXT_color_buffer_float, unless hierarchy = mip_views, unless scene data answers rays");
    for (const TechniqueEntry& entry : technique_table()) {
        SCOPED_TRACE(entry.name);
        EXPECT_EQ(entry.limits.api == Limits::webgl2, entry.name == "diligent_ssr");
        for (const Preset& preset : entry.presets) {
            bool is_lifted = false;
            for (const auto& [name, value] : entry.limits.lifted_by.items())
                is_lifted |= preset.parameters.contains(name) && preset.parameters[name] == value;
            EXPECT_EQ(make_technique(entry.name, {}, preset.name)->limits, is_lifted ? Limits::none : entry.limits.api)
                << preset.name;
        }
        for (const auto& [name, value] : entry.limits.lifted_by.items())
            EXPECT_EQ(make_technique(entry.name, {{name, value}})->limits, Limits::none) << name;
    }
}

TEST_F(Webgl2Technique, HasShadersInGlslEs) {
    const std::vector<std::string> files = fragment_shaders("diligent_ssr");
    EXPECT_FALSE(files.empty());
    for (const std::string& preset : presets_of(find_technique("diligent_ssr"))) {
        const auto technique = make_technique("diligent_ssr", {}, preset);
        const std::string prelude = shader_prelude(technique->params, ShaderLanguage::webgl2);
        for (const std::string& file : files)
            EXPECT_NO_THROW(compile(file, "", prelude, technique->shader_includes(), ShaderLanguage::webgl2))
                << file << ", " << preset;
    }
}

/// Every pass of whole frames, those of variants/common among them; the pass_list compiles their shaders as GLSL ES,
/// too.
TEST_F(Webgl2Technique, RendersWithinTheLimits) {
    for (const std::string& preset : presets_of(find_technique("diligent_ssr")))
        for (const bool half_resolution : {false, true})
            for (const bool previous_frame : {false, true}) {
                const auto technique = make_technique(
                    "diligent_ssr", {{"half_resolution", half_resolution}, {"previous_frame", previous_frame}}, preset);
                EXPECT_NO_THROW(render(*technique, technique->limits))
                    << preset << (half_resolution ? ", half resolution" : "")
                    << (previous_frame ? ", previous frame" : "");
            }
}

TEST_F(Webgl2Technique, MayLiftThem) {
    const auto technique = make_technique("diligent_ssr", {{"hierarchy", "mip_views"}});
    EXPECT_NO_THROW(render(*technique, technique->limits, 1));
    EXPECT_EQ(
        error_message([&] { render(*technique, Limits::webgl2, 1); }),
        "pass diligent_ssr/depth_hierarchy reads 'finer_depth' and draws to it as 'kept_depth', outside the limits "
        "of WebGL 2, which reads no image while it is drawn to");
}

/// The same frame drawn by its ancestor, with compute shaders.
TEST_F(Webgl2Technique, LeaveComputeOut) {
    const auto technique = make_technique("amd_sssr");
    EXPECT_THROW(render(*technique, Limits::webgl2, 1), Error);
}
