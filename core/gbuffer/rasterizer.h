#pragma once
#include "core/gbuffer/drawn_scene.h"
#include "core/gbuffer/environment_images.h"
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/scene_facts.h"
#include "core/left_out.h"

struct RasterizerOptions {
    glm::uvec2 extent{0, 0};
    DepthFormat depth_format = DepthFormat::d32f;
    unsigned normal_bits = 0;       ///< of each of the two numbers that the shading normal is stored in
                                    ///< (core/shaders/gbuffer/octahedral.glsl), 2 to 16; 0: floats
    bool has_depth_layers = false;  ///< also GBuffer::second_depth and ::back_depth
    /// What reflections show where nothing is found for them, in place of the scene's environment: a reflection probe.
    /// It must outlive the rasteriser.
    const Environment* probe = nullptr;
    bool is_still = false;  ///< in all frames that will be asked for neither camera nor scene moves
    bool keep_all = false;  ///< run and compile also what left_out() names: the same images, slower
};

/// What a rasteriser leaves out of frames with these facts.
std::vector<LeftOut> left_out_of_rasterizer(const SceneFacts& facts);

/// Draws the G-buffer of a scene. It has a pass pass_list of its own, so that its times are not those of a technique;
/// techniques read its images through theirs, after render() has waited for the device.
///
/// Surfaces are drawn from both sides, their normals turned to the camera, as the path tracer sees them, but for backs
/// that the scene hides (Scene::hides_backs_of()); where they are drawn the back of a single-sided emitter is dark.
class Rasterizer {
public:
    /// Uploads the scene and prefilters its environment. `scene` must outlive the rasteriser. Fails with MachineError
    /// if the device lacks the depth format.
    Rasterizer(Device& device, const Scene& scene, const RasterizerOptions& options);

    /// The G-buffer of one frame, all but `lit`, which one of the functions below fills. view.extent must be that of
    /// the options. view.predecessor() is drawn first unless it was the last one drawn; the first frame has none, and
    /// gets its own depth and normal as the previous ones. With view.jitter samples lie at pixel centre + jitter.
    GBuffer render(const SceneCamera& camera, const FrameView& view);

    /// Emission and direct diffuse light, of punctual lights and of the environment, without any shadow. Seconds faster
    /// than tracing paths, and so wrong that results must say that it was used.
    void light_directly(const GBuffer& gbuffer);
    /// Path-traced lit colour: RGB of the same extent.
    void upload_lit(const GBuffer& gbuffer, const HostImage& rgb);

    const CameraData& camera() const { return camera_; }  ///< of the last frame
    const Scene& scene() const { return scene_; }
    const PrefilteredEnvironment& prefiltered_environment() const { return environment_.prefiltered(); }
    PassList& pass_list() { return pass_list_; }

private:
    bool needs_fallback() const;
    const Environment& reflected_environment() const;
    struct Frame;
    Frame pose(const SceneCamera& camera, const FrameView& view) const;
    GBuffer draw(const Frame& frame);
    void draw_kind(const GBuffer& gbuffer, const Image& depth_buffer, DrawnScene::Kind kind, const char* name);
    void draw_depth_layers(GBuffer& gbuffer);
    const Scene& scene_;
    RasterizerOptions options_;
    SceneFacts facts_;  ///< of the materials and lights; motion is looked at frame by frame
    PassList pass_list_;
    DrawnScene drawn_;
    EnvironmentImages environment_;
    ParameterSet no_params_;
    CameraData camera_{};
    ScenePose scene_pose_;
    const SceneCamera* last_camera_ = nullptr;
    FrameView last_view_;
};
