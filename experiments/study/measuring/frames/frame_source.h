#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "core/gbuffer/rasterizer.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/frames/capture.h"

#include <map>
#include <memory>
#include <optional>

/// Where the G-buffers of a shot come from: a scene that is rasterised, or files.
class FrameSource {
public:
    virtual ~FrameSource() = default;

    /// The G-buffer of a frame with the lit colour `lit` (RGB), and camera() of it. Its times are those of pass_list(),
    /// and its images are valid until the next one is rendered.
    virtual GBuffer render(const FrameStep& step, unsigned seed, const HostImage& lit) = 0;
    virtual const CameraData& camera() const = 0;
    virtual PassList& pass_list() = 0;
};

/// Rasterises shot.scene. With shot.config.direct_lit its lit colour is rasterised direct light, and `lit` is not
/// looked at. `probe`: what reflections fall back to, which outlives the source; none: the environment, and Error for a
/// shot that asks for a probe.
std::unique_ptr<FrameSource> scene_source(Device& device, const Shot& shot, const Config& config, bool keep_all,
                                          const Environment* probe = nullptr);

/// The frames of a capture. With `reads_own_lit` their lit colour is the files', and `lit` is not looked at.
std::unique_ptr<FrameSource> capture_source(Device& device, Capture& capture, const Shot& shot, bool reads_own_lit);

/// The G-buffers of a shot, each rendered once: every technique, point and seed reads the same images, since no seed
/// enters them. Frames that do not fit into the memory are rendered again whenever they are asked for.
class FrameStore {
public:
    /// `max_bytes` of device memory at most.
    FrameStore(FrameSource& source, const ShotConfig& shot, size_t max_bytes);
    ~FrameStore();

    struct Frame {
        GBuffer gbuffer;    ///< its images are valid until the next call
        CameraData camera;  ///< with the index of the step, and seed 0
    };
    Frame frame(const FrameStep& step, const HostImage& lit);

    /// Whether all frames that were asked for so far are kept.
    bool keeps_all() const;

    /// Values that are NaN or infinite, by layer, over all frames so far (each counted once): see count_non_finite().
    const std::map<std::string, size_t>& non_finite() const { return non_finite_; }

private:
    struct Stored;
    FrameSource& source_;
    DepthFormat depth_format_;
    GBufferFormats formats_;
    size_t max_bytes_, bytes_ = 0;
    /// By pose and pose before: a held pose looks the same each time. Without value: it did not fit.
    std::map<std::pair<unsigned, std::optional<unsigned>>, std::unique_ptr<Stored>> stored_;
    std::map<std::string, size_t> non_finite_;
};
