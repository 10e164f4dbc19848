#pragma once
#include "core/gbuffer/drawn_scene.h"
#include "core/gbuffer/environment_images.h"
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/scene_facts.h"
#include "core/left_out.h"

struct RasterizerOptions {
    glm::uvec2 extent{0, 0};
    DepthFormat depth_format = DepthFormat::d32f;
    unsigned normal_bits = 0;       ///< bits of each of the two numbers that store the shading normal
                                    ///< (core/shaders/gbuffer/octahedral.glsl), 2 to 16; 0: floats
    bool has_depth_layers = false;  ///< also GBuffer::second_depth and ::back_depth
    /// A reflection probe: reflections that find nothing show it instead of the scene's environment. Must outlive the
    /// rasteriser.
    const Environment* probe = nullptr;
    bool is_still = false;  ///< neither camera nor scene moves in the frames that will be rendered
    bool keep_all = false;  ///< also compile and run what left_out_of_rasterizer() names: the same images, slower
};

/// What a rasteriser leaves out of frames with these facts.
std::vector<LeftOut> left_out_of_rasterizer(const SceneFacts& facts);

/// Draws the G-buffer of a scene. Its own pass list keeps its times apart from a technique's. Techniques read its
/// images through their pass lists, after render() has waited for the device.
///
/// Surfaces are drawn from both sides, with normals turned to the camera, as in the path tracer. Backs that the scene
/// hides are not drawn (Scene::hides_backs_of()). The back of a single-sided emitter is dark.
class Rasterizer {
public:
    /// Uploads the scene and prefilters its environment. `scene` must outlive the rasteriser. Fails with MachineError
    /// if the device lacks the depth format.
    Rasterizer(Device& device, const Scene& scene, const RasterizerOptions& options);

    /// The G-buffer of one frame, except `lit`, which a function below fills. view.extent must be that of the options.
    /// view.predecessor() is drawn first unless it was drawn last. The first frame has none: its previous depth and
    /// normal are its own. With view.jitter samples lie at pixel centre + jitter.
    GBuffer render(const SceneCamera& camera, const FrameView& view);

    /// Fills `lit` with emission and direct diffuse light of punctual lights and environment, without shadows. Saves
    /// seconds of path tracing, but is so wrong that results must report its use.
    void light_directly(const GBuffer& gbuffer);
    /// Fills `lit` with path-traced lit colour: RGB of the same extent.
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
