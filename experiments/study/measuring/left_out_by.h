#pragma once
#include "core/left_out.h"
#include "experiments/study/config/shots/shot.h"
#include "variants/common/technique.h"

#include <map>
#include <memory>

/// A part of the work on a shot that one renderer leaves out.
struct LeftOutBy {
    std::string who;  ///< "path tracer", "rasteriser", or a technique
    LeftOut part;
};

/// Finds what renderers leave out of shots. What shots have in common is found once: a scene's frame for the path
/// tracer, equal facts for techniques.
class LeftOutFinder {
public:
    /// `techniques` must outlive it.
    explicit LeftOutFinder(const std::vector<PointConfig>& techniques);

    /// What path tracer and rasteriser leave out of a shot (nothing of a G-buffer from files), then each technique with
    /// all of its points, in their order.
    std::vector<LeftOutBy> of(const Shot& shot);

private:
    const std::vector<LeftOut>& of_path_tracer(const Shot& shot);
    const std::vector<LeftOutBy>& of_techniques(const SceneFacts& facts);

    std::vector<std::pair<std::string, std::unique_ptr<Technique>>> techniques_;  ///< by the texts of their points
    std::map<std::pair<std::string, unsigned>, std::vector<LeftOut>>
        of_path_tracer_;                                           ///< by the scene's content, frame
    std::map<std::string, std::vector<LeftOutBy>> of_techniques_;  ///< by the facts' text
};

/// LeftOutFinder::of() for one shot.
std::vector<LeftOutBy> left_out_of(const Shot& shot, const std::vector<PointConfig>& techniques);
