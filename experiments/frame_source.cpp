#include "experiments/frame_source.h"

#include "core/error.h"
#include "core/gbuffer/gbuffer_transfer.h"

namespace {

class SceneSource final : public FrameSource {
public:
    SceneSource(Device& device, const Shot& shot, const Config& config, bool keep_all)
        : shot_(shot), config_(config), rasterizer_(device, shot.scene, {.extent = shot.config.extent, .depth_format = config.depth_format, .keep_all = keep_all}) {}

    GBuffer render(unsigned frame, unsigned seed, const HostImage& lit) override {
        const GBuffer gbuffer = rasterizer_.render(shot_.camera, {.extent = shot_.config.extent, .depth_direction = config_.depth_direction, .frame = frame, .seed = seed});
        if (config_.direct_lit)
            rasterizer_.light_directly(gbuffer);
        else
            rasterizer_.upload_lit(gbuffer, lit);
        return gbuffer;
    }
    const CameraData& camera() const override { return rasterizer_.camera(); }
    PassGraph& graph() override { return rasterizer_.graph(); }
    const std::vector<LeftOut>& left_out() const override { return rasterizer_.left_out(); }

private:
    const Shot& shot_;
    const Config& config_;
    Rasterizer rasterizer_;
};

class FileSource final : public FrameSource {
public:
    FileSource(Device& device, HostGBuffer gbuffer) : camera_(gbuffer.camera), has_lit_(!gbuffer.lit.values.empty()), graph_(device, gbuffer.extent()), gbuffer_(upload_gbuffer(graph_, gbuffer)) {}

    GBuffer render(unsigned, unsigned seed, const HostImage& lit) override {
        camera_.frame.y = seed;
        if (!has_lit_) {
            if (lit.values.empty()) fail("the G-buffer has no lit colour, and no reference provides one: give it the layer 'lit', or name a 'reference'");
            HostImage rgba(lit.extent, 4, 1.0f);
            for (size_t i = 0; i < lit.pixel_count(); ++i) rgba.set_rgb(i, lit.rgb(i));
            graph_.upload(gbuffer_.lit, rgba);
        }
        return gbuffer_;
    }
    const CameraData& camera() const override { return camera_; }
    PassGraph& graph() override { return graph_; }
    const std::vector<LeftOut>& left_out() const override { return nothing_; }

private:
    CameraData camera_;
    bool has_lit_;
    PassGraph graph_;
    GBuffer gbuffer_;
    std::vector<LeftOut> nothing_;
};

}  // namespace

std::unique_ptr<FrameSource> scene_source(Device& device, const Shot& shot, const Config& config, bool keep_all) { return std::make_unique<SceneSource>(device, shot, config, keep_all); }
std::unique_ptr<FrameSource> file_source(Device& device, HostGBuffer gbuffer) { return std::make_unique<FileSource>(device, std::move(gbuffer)); }
