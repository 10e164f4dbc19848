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

/// What a case shows, and the truth of its last frame. Frames that look alike share their images.
struct CaseFrames {
    std::shared_ptr<const Shot> shot;
    std::vector<CaseFrame> steps;
    HostImage truth;                 ///< RGB: specular radiance of the last frame; empty: not known
    std::vector<uint8_t> is_judged;  ///< by pixel: all that the last G-buffer holds of it is finite, and it reflects
    std::shared_ptr<const Reference> reference;  ///< null with `truth` empty
    std::vector<std::shared_ptr<void>> owners;   ///< of what the frames' images lie in
};

/// Draws cases, by what draws the shots of a study. References come from the cache that studies have.
class CaseDrawer {
public:
    /// `points`: who will read the frames. `cache`: of references.
    CaseDrawer(Device& device, std::vector<std::filesystem::path> search_path, std::filesystem::path cache,
               const std::vector<PointConfig>& points);

    /// `perturbation`, if there is one, changes each G-buffer after the case's faults.
    CaseFrames draw(const CaseScene& scene, const std::vector<InputFault>& faults = {},
                    const std::function<void(HostGBuffer&)>& perturbation = {});

private:
    Device& device_;
    std::vector<std::filesystem::path> search_path_;
    std::filesystem::path cache_;
    Config config_;
};

/// Whether every value that the G-buffer holds of the pixel is finite.
bool is_sound(const HostGBuffer& gbuffer, size_t pixel);
