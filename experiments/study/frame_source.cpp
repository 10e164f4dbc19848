#include "experiments/study/frame_source.h"

#include "core/error.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "variants/registry.h"

#include <algorithm>

namespace {

bool needs_depth_layers(const VariantConfig& variant) {
    return make_variant(variant.variant, variant.parameters, variant.preset)->needs_depth_layers();
}

class SceneSource final : public FrameSource {
public:
    SceneSource(Device& device, const Shot& shot, const Config& config, bool keep_all)
        : shot_(shot),
          rasterizer_(device, shot.scene,
                      {.extent = shot.config.extent,
                       .depth_format = shot.config.depth_format,
                       .normal_bits = shot.config.normal_bits,
                       .has_depth_layers = std::ranges::any_of(config.variants, needs_depth_layers),
                       .is_still = shot.facts.is_still(),
                       .keep_all = keep_all}) {}

    GBuffer render(const FrameStep& step, unsigned seed, const HostImage& lit) override {
        const GBuffer gbuffer = rasterizer_.render(shot_.camera, {.extent = shot_.config.extent,
                                                                  .depth_direction = shot_.config.depth_direction,
                                                                  .frame = step.frame,
                                                                  .seed = seed,
                                                                  .index = step.index,
                                                                  .previous_frame = step.previous_frame});
        if (shot_.config.direct_lit)
            rasterizer_.light_directly(gbuffer);
        else
            rasterizer_.upload_lit(gbuffer, lit);
        return gbuffer;
    }
    const CameraData& camera() const override { return rasterizer_.camera(); }
    PassGraph& graph() override { return rasterizer_.graph(); }

private:
    const Shot& shot_;
    Rasterizer rasterizer_;
};

class FileSource final : public FrameSource {
public:
    FileSource(Device& device, HostGBuffer gbuffer)
        : camera_(gbuffer.camera),
          has_lit_(!gbuffer.lit.values.empty()),
          graph_(device, gbuffer.extent()),
          gbuffer_(upload_gbuffer(graph_, gbuffer)) {}

    GBuffer render(const FrameStep& step, unsigned seed, const HostImage& lit) override {
        // Whatever the file says: what was rendered before is known here.
        camera_.frame.x = step.index, camera_.frame.y = seed, camera_.frame.w = step.previous_frame.has_value();
        if (!has_lit_) {
            if (lit.values.empty())
                fail(
                    "the G-buffer has no lit colour, and no reference provides one: give it the layer 'lit', or name a "
                    "'reference'");
            HostImage rgba(lit.extent, 4, 1.0f);
            for (size_t i = 0; i < lit.pixel_count(); ++i) rgba.set_rgb(i, lit.rgb(i));
            graph_.upload(gbuffer_.lit, rgba);
        }
        return gbuffer_;
    }
    const CameraData& camera() const override { return camera_; }
    PassGraph& graph() override { return graph_; }

private:
    CameraData camera_;
    bool has_lit_;
    PassGraph graph_;
    GBuffer gbuffer_;
};

}  // namespace

std::unique_ptr<FrameSource> scene_source(Device& device, const Shot& shot, const Config& config, bool keep_all) {
    return std::make_unique<SceneSource>(device, shot, config, keep_all);
}
std::unique_ptr<FrameSource> file_source(Device& device, HostGBuffer gbuffer) {
    return std::make_unique<FileSource>(device, std::move(gbuffer));
}

struct FrameStore::Stored {
    PassGraph graph;  ///< owns the images
    GBuffer gbuffer;
    CameraData camera;

    Stored(Device& device, const HostGBuffer& host)
        : graph(device, host.extent()), gbuffer(upload_gbuffer(graph, host)), camera(host.camera) {}
};

FrameStore::FrameStore(FrameSource& source, DepthFormat depth_format, size_t max_bytes)
    : source_(source), depth_format_(depth_format), max_bytes_(max_bytes) {}
FrameStore::~FrameStore() = default;

FrameStore::Frame FrameStore::frame(const FrameStep& step, const HostImage& lit) {
    constexpr size_t bytes_per_pixel = 140;  // of the formats in gbuffer.h, with both depth layers
    const auto key = std::pair(step.frame, step.previous_frame);
    auto found = stored_.find(key);
    if (found == stored_.end() || !found->second) {
        const GBuffer rendered = source_.render(step, 0, lit);
        if (found != stored_.end()) return {rendered, source_.camera()};
        const HostGBuffer host = download_gbuffer(source_.graph(), rendered, source_.camera(), depth_format_);
        for (const auto& [layer, count] : count_non_finite(host)) non_finite_[layer] += count;
        found = stored_.emplace(key, nullptr).first;
        const size_t bytes = bytes_per_pixel * host.depth.pixel_count();
        if (bytes_ + bytes > max_bytes_) return {rendered, source_.camera()};
        bytes_ += bytes;
        found->second = std::make_unique<Stored>(source_.graph().device(), host);
        found->second->gbuffer.environment = rendered.environment;
    }
    Frame frame{found->second->gbuffer, found->second->camera};
    frame.camera.frame.x = step.index;
    return frame;
}
