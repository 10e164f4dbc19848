#pragma once
#include "experiments/bridges/shader_export/frame_passes.h"
#include "experiments/gpu_costs/spirv/shader_layout.h"

#include <set>

/// How long the content of a technique's own images and buffers lives.
class ResourceLives {
public:
    /// `layouts`: of each command of the second frame; empty for clears.
    ResourceLives(const FramePasses& frames, const std::vector<ShaderLayout>& layouts);

    /// Whether the resource has two sides, which are exchanged at the begin of each frame.
    bool is_history(const std::string& resource) const;
    /// Whether `used` of the second frame is the side that the frame before wrote.
    bool is_previous(const UsedResource& used) const;
    /// Whether a frame reads the resource before it writes it, so that its content must be kept.
    bool is_kept(const std::string& resource) const { return kept_.contains(resource); }

private:
    std::map<std::string, std::set<const void*>> sides_;
    std::set<const void*> written_, previous_;  ///< in the second frame
    std::set<std::string> kept_;
};
