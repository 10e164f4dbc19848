#pragma once
#include "core/gbuffer/rasterizer.h"
#include "core/gpu/device.h"
#include "experiments/stability/stability_case.h"
#include "groundtruth/reference.h"

#include <map>
#include <memory>
#include <mutex>

/// One rendered frame of a case, as techniques read it.
struct CaseFrame {
    std::shared_ptr<const HostGBuffer> host;  ///< with the case's faults
    GBuffer gbuffer;
    CameraData camera;
};

/// What a case shows, and the truth of its last frame. Frames that look alike share their images.
struct CaseFrames {
    std::vector<CaseFrame> steps;
    HostImage truth;                             ///< RGB: specular radiance of the last frame; empty: not known
    std::vector<uint8_t> is_sound;               ///< by pixel: all that the last G-buffer holds of it is finite
    std::vector<uint8_t> is_judged;              ///< ... and it reflects
    std::shared_ptr<const Reference> reference;  ///< null with `truth` empty
    std::vector<std::shared_ptr<void>> owners;   ///< of what the frames' images lie in
};

/// The path-traced pictures of cases, each made once. For several threads.
class TruthStore {
public:
    std::shared_ptr<const Reference> get(const Scene& scene, const SceneCamera& camera, glm::uvec2 size, unsigned pose);

private:
    std::mutex mutex_;  ///< also held while one is made, which uses all cores
    std::map<std::string, std::shared_ptr<const Reference>> known_;  ///< by all that decides them
};

/// Draws cases.
class CaseDrawer {
public:
    CaseDrawer(Device& device, std::vector<std::filesystem::path> search_path, TruthStore& truths)
        : device_(device), search_path_(std::move(search_path)), truths_(truths) {}

    /// `perturbation`, if there is one, changes each G-buffer after the case's faults.
    CaseFrames draw(const CaseScene& scene, const std::vector<InputFault>& faults = {},
                    const std::function<void(HostGBuffer&)>& perturbation = {});

private:
    Device& device_;
    std::vector<std::filesystem::path> search_path_;
    TruthStore& truths_;
};

/// Whether every value that the G-buffer holds of the pixel is finite.
bool is_sound(const HostGBuffer& gbuffer, size_t pixel);
