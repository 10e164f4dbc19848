#pragma once
#include "core/gpu/device.h"
#include "experiments/study/measuring/frames/frame_source.h"
#include "experiments/study/stability/stability_case.h"
#include "groundtruth/reference/reference.h"

#include <functional>
#include <memory>

/// One rendered frame of a case, as techniques read it.
struct CaseFrame {
    std::shared_ptr<const HostGBuffer> host;  ///< with the case's faults
    GBuffer gbuffer;
    CameraData camera;
};

/// The frames of a case, and the truth of its last frame. Frames that look alike share their images.
struct CaseFrames {
    std::shared_ptr<const Shot> shot;
    std::vector<CaseFrame> steps;
    HostImage truth;                 ///< RGB: specular radiance of the last frame; empty: unknown
    std::vector<uint8_t> is_judged;  ///< by pixel: it reflects, and its values in the last G-buffer are finite
    std::shared_ptr<const Reference> reference;  ///< null with `truth` empty
    std::vector<std::shared_ptr<void>> owners;   ///< owners of the frames' images
};

/// Draws cases with the code that draws shots of studies. References come from the same cache as those of studies.
class CaseDrawer {
public:
    /// `points`: the points that will read the frames. `cache`: of references.
    CaseDrawer(Device& device, std::vector<std::filesystem::path> search_path, std::filesystem::path cache,
               const std::vector<PointConfig>& points);

    /// Draws the frames of a case; `perturbation`, if there is one, changes each G-buffer after the case's faults.
    CaseFrames draw(const CaseScene& scene, const std::vector<InputFault>& faults = {},
                    const std::function<void(HostGBuffer&)>& perturbation = {});

private:
    Device& device_;
    std::vector<std::filesystem::path> search_path_;
    std::filesystem::path cache_;
    Config config_;
};

/// Whether all values of the pixel in the G-buffer are finite.
bool is_sound(const HostGBuffer& gbuffer, size_t pixel);
