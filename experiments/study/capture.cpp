#include "experiments/study/capture.h"

#include "core/error.h"
#include "groundtruth/reference_file.h"

#include <cmath>

namespace {

/// Share of the pixels that see another surface than the G-buffer does, by 1 % of their distance.
double share_that_differs(const Reference& reference, const HostGBuffer& gbuffer) {
    size_t count = 0;
    for (size_t i = 0; i < gbuffer.depth.values.size(); ++i) {
        const float device_depth = gbuffer.depth.values[i], expected = reference.depth.values[i];
        const float depth = device_depth == gbuffer.camera.depth.z ? 0.0f : view_distance(gbuffer.camera, device_depth);
        count += std::abs(depth - expected) > 0.01f * std::max(depth, expected);
    }
    return double(count) / double(gbuffer.depth.values.size());
}

}  // namespace

std::string capture_name(const std::filesystem::path& gbuffer) {
    return std::filesystem::absolute(gbuffer / "").lexically_normal().parent_path().filename().string();
}

Reference read_capture_reference(const std::filesystem::path& file, const HostGBuffer& gbuffer, bool needs_ladder) {
    Reference reference = read_reference(file);
    if (needs_ladder && reference.ladder.is_empty())
        fail(file.string(),
             " has no truth ladder, which the targets 'camera_radiance' and 'on_screen' need; render it ",
             "with `ssrlab reference --ladder`, or leave them out of 'targets'");
    if (reference.extent != gbuffer.extent())
        fail(file.string(), " is ", reference.extent.x, "x", reference.extent.y, ", but the G-buffer is ",
             gbuffer.extent().x, "x", gbuffer.extent().y);
    // A rasteriser and a ray tracer disagree in some pixels of edges and foliage; another camera changes nearly all.
    const double share = share_that_differs(reference, gbuffer);
    if (share > 0.25)
        fail(file.string(), " does not belong to the G-buffer: the depths of ", std::lround(100 * share),
             " % of their pixels differ by more than 1 %, so it was made with another camera, frame or scene");
    return reference;
}
