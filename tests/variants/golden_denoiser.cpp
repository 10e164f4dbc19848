#include "tests/variants/golden_denoiser.h"

#include <algorithm>

namespace {

constexpr float roughness_threshold = 0.2f;  // alpha, of the original's run

HostImage negated(HostImage image) {
    for (float& value : image.values) value = -value;
    return image;
}

GoldenDenoiserFrame read_frame(const std::string& folder, const CameraData& camera) {
    const LayeredImage gbuffer = read_golden(folder + "gbuffer.exr"), traced = read_golden(folder + "intersect.exr"),
                       reproject = read_golden(folder + "reproject.exr"),
                       prefilter = read_golden(folder + "prefilter.exr"), resolve = read_golden(folder + "resolve.exr");
    HostImage radiance = resized_channels(golden_layer(traced, "rad"), 4);
    const HostImage& length = golden_layer(traced, "len");
    for (size_t i = 0; i < length.values.size(); ++i) radiance.values[4 * i + 3] = length.values[i];
    return {.inputs = {.camera = camera,
                       .depth = golden_layer(gbuffer, "depth"),
                       .normal = resized_channels(golden_layer(gbuffer, "normal"), 4),
                       .motion = negated(golden_layer(gbuffer, "motion")),
                       .radiance = std::move(radiance),
                       .roughness = golden_layer(traced, "alpha8"),
                       .tiles = golden_layer(read_golden(folder + "tiles.exr"), "tile")},
            .reprojected = golden_layer(reproject, "rad"),
            .reprojected_variance = golden_layer(reproject, "var"),
            .sample_count = golden_layer(reproject, "count"),
            .average = golden_layer(read_golden(folder + "average.exr"), "avg"),
            .prefiltered = golden_layer(prefilter, "rad"),
            .prefiltered_variance = golden_layer(prefilter, "var"),
            .resolved = golden_layer(resolve, "rad"),
            .resolved_variance = golden_layer(resolve, "var")};
}

}  // namespace

bool GoldenDenoiserFrame::is_compared(unsigned x, unsigned y, unsigned border) const {
    if (std::min(x, y) < border || x + border >= resolved.extent.x || y + border >= resolved.extent.y) return false;
    return *inputs.tiles.pixel(x / 8, y / 8) > 0 && *inputs.roughness.pixel(x, y) < roughness_threshold;
}

std::vector<GoldenDenoiserFrame> read_denoiser_frames(const std::string& set) {
    const nlohmann::json meta = golden_meta(set);
    std::vector<GoldenDenoiserFrame> frames;
    for (const nlohmann::json& frame : meta["frames"]) {
        const unsigned index = frame["frame"];
        frames.push_back(
            read_frame(set + "/f" + std::to_string(index) + "/", golden_camera(meta, frame["camera"], index)));
    }
    return frames;
}

std::vector<std::string> golden_denoiser_sets() {
    std::vector<std::string> sets = golden_sets("amd/");
    std::erase_if(sets, [](const std::string& set) { return !is_golden(set + "/f0/resolve.exr"); });
    return sets;
}
