#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "core/gbuffer/rasterizer.h"
#include "experiments/config.h"
#include "experiments/shot.h"

#include <memory>

/// Where the G-buffers of a shot come from: a scene that is rasterised, or a file.
class FrameSource {
public:
    virtual ~FrameSource() = default;

    /// The G-buffer of a frame with the lit colour `lit` (RGB), and camera() of it. Its times are those of graph().
    virtual GBuffer render(unsigned frame, unsigned seed, const HostImage& lit) = 0;
    virtual const CameraData& camera() const = 0;
    virtual PassGraph& graph() = 0;
    virtual const std::vector<LeftOut>& left_out() const = 0;
};

/// Rasterises shot.scene. With config.direct_lit its lit colour is rasterised direct light, and `lit` is not looked at.
std::unique_ptr<FrameSource> scene_source(Device& device, const Shot& shot, const Config& config, bool keep_all);

/// The same G-buffer for every frame. `lit` is not looked at if the file has a lit colour.
std::unique_ptr<FrameSource> file_source(Device& device, HostGBuffer gbuffer);
