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

    /// Renders the G-buffer of a frame with the lit colour `lit` (RGB), and sets camera(). Times are those of
    /// pass_list(). Images are valid until the next call.
    virtual GBuffer render(const FrameStep& step, unsigned seed, const HostImage& lit) = 0;
    virtual const CameraData& camera() const = 0;
    virtual PassList& pass_list() = 0;
};

/// Rasterises shot.scene. With shot.config.direct_lit the lit colour is rasterised direct light, and `lit` is ignored.
/// `probe`: what reflections fall back to; it must outlive the source. Without a probe they fall back to the
/// environment; fails with Error if the shot asks for a probe.
std::unique_ptr<FrameSource> scene_source(Device& device, const Shot& shot, const Config& config, bool keep_all,
                                          const Environment* probe = nullptr);

/// Loads the frames of a capture. With `reads_own_lit` the lit colour is the files' own, and `lit` is ignored.
std::unique_ptr<FrameSource> capture_source(Device& device, Capture& capture, const Shot& shot, bool reads_own_lit);

/// The G-buffers of a shot, each rendered once. G-buffers do not depend on seeds, so all techniques, points and seeds
/// read the same images. Frames that exceed the memory are rendered again whenever they are asked for.
class FrameStore {
public:
    /// Uses at most `max_bytes` of device memory.
    FrameStore(FrameSource& source, const ShotConfig& shot, size_t max_bytes);
    ~FrameStore();

    struct Frame {
        GBuffer gbuffer;    ///< its images are valid until the next call
        CameraData camera;  ///< with the step's index, and seed 0
    };
    Frame frame(const FrameStep& step, const HostImage& lit);

    /// Whether all frames that were asked for so far are kept.
    bool keeps_all() const;

    /// Number of NaN and infinite values by layer, over all frames so far, each counted once: see count_non_finite().
    const std::map<std::string, size_t>& non_finite() const { return non_finite_; }

private:
    struct Stored;
    FrameSource& source_;
    DepthFormat depth_format_;
    GBufferFormats formats_;
    size_t max_bytes_, bytes_ = 0;
    /// Frames by pose and previous pose: a held pose looks the same each time. Null: the frame did not fit.
    std::map<std::pair<unsigned, std::optional<unsigned>>, std::unique_ptr<Stored>> stored_;
    std::map<std::string, size_t> non_finite_;
};
