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
    return {.camera = camera,
            .depth = golden_layer(gbuffer, "depth"),
            .normal = resized_channels(golden_layer(gbuffer, "normal"), 4),
            .motion = negated(golden_layer(gbuffer, "motion")),
            .radiance = std::move(radiance),
            .roughness = golden_layer(traced, "alpha8"),
            .tiles = golden_layer(read_golden(folder + "tiles.exr"), "tile"),
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

HostImage resized_channels(const HostImage& image, unsigned channels) {
    HostImage result(image.extent, channels);
    for (size_t i = 0; i < image.pixel_count(); ++i)
        for (unsigned c = 0; c < std::min(channels, image.channels); ++c)
            result.values[i * channels + c] = image.values[i * image.channels + c];
    return result;
}

bool GoldenDenoiserFrame::is_compared(unsigned x, unsigned y, unsigned border) const {
    if (std::min(x, y) < border || x + border >= depth.extent.x || y + border >= depth.extent.y) return false;
    return *tiles.pixel(x / 8, y / 8) > 0 && *roughness.pixel(x, y) < roughness_threshold;
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

DenoiserBench::DenoiserBench(Device& device, glm::uvec2 extent, const nlohmann::json& parameters)
    : graph(device, extent) {
    params.assign(parameters);
    const size_t tiles = size_t((extent.x + 7) / 8) * ((extent.y + 7) / 8);
    work = {.ray_list = {},
            .tile_list = graph.buffer("tiles", 4 * tiles),
            .counters = graph.buffer("counters", 16),
            .indirect_arguments = graph.buffer("arguments", 36)};
}

void DenoiserBench::begin_frame(const GoldenDenoiserFrame& frame, const GoldenDenoiserFrame* before) {
    const auto upload = [&](const char* name, Format format, const HostImage& pixels) {
        const Image image = graph.image(name, format);
        graph.upload(image, pixels);
        return image;
    };
    gbuffer.depth = upload("depth", Format::r32f, frame.depth);
    gbuffer.normal = upload("normal", Format::rgba32f, frame.normal);
    gbuffer.motion = upload("motion", Format::rg32f, frame.motion);
    gbuffer.previous_depth =
        upload("previous_depth", Format::r32f, before ? before->depth : HostImage(graph.extent(), 1));
    gbuffer.previous_normal =
        upload("previous_normal", Format::rgba32f, before ? before->normal : HostImage(graph.extent(), 4));
    graph.begin_frame(frame.camera, params, std::vector{gbuffer.depth, gbuffer.normal, gbuffer.motion});
    histories = amd_histories(graph, denoiser.float_histories, false);
    graph.upload(histories.radiance.current, frame.radiance);
    graph.upload(histories.roughness.current, frame.roughness);
    graph.upload(histories.roughness.previous, before ? before->roughness : HostImage(graph.extent(), 1));

    std::vector<uint32_t> list;
    for (uint32_t y = 0; y < frame.tiles.extent.y; ++y)
        for (uint32_t x = 0; x < frame.tiles.extent.x; ++x)
            if (*frame.tiles.pixel(x, y) > 0) list.push_back(8 * y << 16 | 8 * x);
    const uint32_t count = uint32_t(list.size());
    const uint32_t arguments[9] = {0, 0, 1, count, 1, 1, (count + 7) / 8, 1, 1}, counters[4] = {0, 0, 0, count};
    graph.upload(work.counters, std::as_bytes(std::span(counters)));
    graph.upload(work.tile_list, std::as_bytes(std::span(list)));
    graph.upload(work.indirect_arguments, std::as_bytes(std::span(arguments)));
}
