#include "experiments/study/measuring/frames/frame_source.h"

#include "core/error.h"
#include "core/gbuffer/composite.h"
#include "core/gbuffer/environment_images.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "experiments/study/config/points/technique_of.h"

#include <algorithm>

namespace {

bool needs_depth_layers(const PointConfig& technique) { return technique_of(technique)->needs_depth_layers(); }

class SceneSource final : public FrameSource {
public:
    SceneSource(Device& device, const Shot& shot, const Config& config, bool keep_all, const Environment* probe)
        : shot_(shot),
          rasterizer_(device, shot.scene,
                      {.extent = shot.config.extent,
                       .depth_format = shot.config.depth_format,
                       .normal_bits = shot.config.normal_bits,
                       .has_depth_layers = std::ranges::any_of(config.techniques, needs_depth_layers),
                       .probe = probe,
                       .is_still = shot.facts.is_still(),
                       .keep_all = keep_all}),
          compositor_(rasterizer_.pass_list()) {
        rasterizer_.pass_list().set_changes(gbuffer_changes(shot.config.gbuffer_formats));
    }

    GBuffer render(const FrameStep& step, unsigned seed, const HostImage& lit) override {
        GBuffer gbuffer = rasterizer_.render(shot_.camera, {.extent = shot_.config.extent,
                                                            .depth_direction = shot_.config.depth_direction,
                                                            .frame = step.frame,
                                                            .seed = seed,
                                                            .index = step.index,
                                                            .previous_frame = step.previous_frame});
        if (shot_.config.direct_lit)
            rasterizer_.light_directly(gbuffer);
        else
            rasterizer_.upload_lit(gbuffer, lit);
        if (shot_.config.lit_has_environment) compositor_.add_environment(gbuffer);
        return gbuffer;
    }
    const CameraData& camera() const override { return rasterizer_.camera(); }
    PassList& pass_list() override { return rasterizer_.pass_list(); }

private:
    const Shot& shot_;
    Rasterizer rasterizer_;
    Compositor compositor_;
};

class CaptureSource final : public FrameSource {
public:
    CaptureSource(Device& device, Capture& capture, const Shot& shot, bool reads_own_lit)
        : capture_(capture),
          reads_own_lit_(reads_own_lit),
          lit_has_environment_(shot.config.lit_has_environment),
          pass_list_(device, shot.config.extent),
          compositor_(pass_list_) {
        pass_list_.set_changes(gbuffer_changes(shot.config.gbuffer_formats));
        if (capture.environment()) environment_.emplace(pass_list_, *capture.environment(), false);
    }

    GBuffer render(const FrameStep& step, unsigned seed, const HostImage& lit) override {
        HostGBuffer host = capture_.played(step.frame, step.previous_frame);
        if (!reads_own_lit_) {
            if (lit.values.empty())
                fail(
                    capture_.folder_of(step.frame).string(),
                    ": the G-buffer has no lit colour, and no reference provides one: give it the layer 'lit', or name "
                    "a 'reference'");
            host.lit = HostImage(lit.extent, 4, 1.0f);
            for (size_t i = 0; i < lit.pixel_count(); ++i) host.lit.set_rgb(i, lit.rgb(i));
        }
        camera_ = host.camera;
        camera_.frame.x = step.index, camera_.frame.y = seed;
        pass_list_.begin_frame(camera_, no_params_, {});
        GBuffer gbuffer = upload_gbuffer(pass_list_, host);
        if (lit_has_environment_) compositor_.add_environment(gbuffer);
        if (environment_) gbuffer.environment = &*environment_;
        return gbuffer;
    }
    const CameraData& camera() const override { return camera_; }
    PassList& pass_list() override { return pass_list_; }

private:
    Capture& capture_;
    bool reads_own_lit_, lit_has_environment_;
    CameraData camera_{};
    PassList pass_list_;
    Compositor compositor_;
    ParameterSet no_params_;
    std::optional<EnvironmentImages> environment_;
};

}  // namespace

std::unique_ptr<FrameSource> scene_source(Device& device, const Shot& shot, const Config& config, bool keep_all,
                                          const Environment* probe) {
    if (shot.config.has_probe && !probe)
        fail(shot.name(), ": reflection probes are made by `ssrlab run` alone: leave out \"fallback\": \"probe\"");
    return std::make_unique<SceneSource>(device, shot, config, keep_all, probe);
}
std::unique_ptr<FrameSource> capture_source(Device& device, Capture& capture, const Shot& shot, bool reads_own_lit) {
    return std::make_unique<CaptureSource>(device, capture, shot, reads_own_lit);
}

struct FrameStore::Stored {
    PassList pass_list;  ///< owns the images
    GBuffer gbuffer;
    CameraData camera;

    Stored(Device& device, const HostGBuffer& host, GBufferFormats formats)
        : pass_list(device, host.extent()), camera(host.camera) {
        pass_list.set_changes(gbuffer_changes(formats));
        gbuffer = upload_gbuffer(pass_list, host);
    }
};

FrameStore::FrameStore(FrameSource& source, const ShotConfig& shot, size_t max_bytes)
    : source_(source), depth_format_(shot.depth_format), formats_(shot.gbuffer_formats), max_bytes_(max_bytes) {}
FrameStore::~FrameStore() = default;

bool FrameStore::keeps_all() const {
    return std::ranges::none_of(stored_, [](const auto& frame) { return frame.second == nullptr; });
}

FrameStore::Frame FrameStore::frame(const FrameStep& step, const HostImage& lit) {
    constexpr size_t bytes_per_pixel = 156;  // of the formats in gbuffer.h, with all that is optional
    const auto key = std::pair(step.frame, step.previous_frame);
    auto found = stored_.find(key);
    if (found == stored_.end() || !found->second) {
        const GBuffer rendered = source_.render(step, 0, lit);
        if (found != stored_.end()) return {rendered, source_.camera()};
        const HostGBuffer host = download_gbuffer(source_.pass_list(), rendered, source_.camera(), depth_format_);
        for (const auto& [layer, count] : count_non_finite(host)) non_finite_[layer] += count;
        found = stored_.emplace(key, nullptr).first;
        const size_t bytes = bytes_per_pixel * host.depth.pixel_count();
        if (bytes_ + bytes > max_bytes_) return {rendered, source_.camera()};
        bytes_ += bytes;
        found->second = std::make_unique<Stored>(source_.pass_list().device(), host, formats_);
        found->second->gbuffer.environment = rendered.environment;
    }
    Frame frame{found->second->gbuffer, found->second->camera};
    frame.camera.frame.x = step.index;
    return frame;
}
