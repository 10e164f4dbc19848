#include "tests/variants/amd_golden.h"

#include "core/error.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cstring>
#include <map>
#include <span>

AmdParameters::AmdParameters() = default;

HostGBuffer amd_golden_gbuffer(const std::string& set) {
    const nlohmann::json meta = golden_meta(set);
    const glm::vec2 from_now_to_before(-1.0f);
    HostGBuffer gbuffer =
        golden_gbuffer(read_golden(set + "/gbuffer.exr"), golden_camera(meta, meta["camera"], 0), from_now_to_before);
    const std::vector<float> constant = meta["env"]["color_encoding"];
    for (size_t i = 0; i < gbuffer.fallback.pixel_count(); ++i)
        gbuffer.fallback.set_rgb(i, {constant[0], constant[1], constant[2]});
    return gbuffer;
}

HostGBuffer amd_golden_hit_gbuffer(const std::string& set) {
    HostGBuffer gbuffer = amd_golden_gbuffer(set);
    encode_hits(gbuffer);
    return gbuffer;
}

namespace {

/// The first `count` words of the buffer.
std::vector<uint32_t> words(PassList& pass_list, const Buffer& buffer, size_t count) {
    const std::vector<std::byte> bytes = pass_list.download(buffer);
    std::vector<uint32_t> values(count);
    if (count > 0) std::memcpy(values.data(), bytes.data(), count * 4);
    return values;
}

/// The passes of one frame on a pass_list of their own.
struct TracedFrame {
    PassList pass_list;
    AmdParameters parameters;
    GBuffer gbuffer;
    AmdHistories histories;
    Tracers::Images images;
    Image confidence;
    AmdWork work;

    TracedFrame(Device& device, const HostGBuffer& host, const nlohmann::json& overrides)
        : pass_list(device, host.extent()), gbuffer(upload_gbuffer(pass_list, host)) {
        parameters.params.assign(overrides);
        pass_list.begin_frame(host.camera, parameters.params, gbuffer.images());
        histories = amd_histories(pass_list, true, parameters.tracing.float_roughness);
        confidence = pass_list.image("confidence", Format::r8);
        images = parameters.tracing.tracers.images(pass_list, gbuffer.depth);
    }

    void classify() { work = amd_classify(pass_list, gbuffer, histories, confidence, parameters.denoiser); }

    /// Puts the listed rays into the order in which one thread lists them, tile after tile. Several threads interleave
    /// tiles, so that rays of others share a subgroup.
    void sort_rays_by_tile() {
        std::vector<uint32_t> rays = words(pass_list, work.ray_list, work.ray_list.size / 4);
        const auto tile_of = [](uint32_t ray) { return std::pair((ray >> 15 & 0x3fff) / 8, (ray & 0x7fff) / 8); };
        std::stable_sort(rays.begin(), rays.begin() + words(pass_list, work.counters, 1)[0],
                         [&](uint32_t a, uint32_t b) { return tile_of(a) < tile_of(b); });
        pass_list.upload(work.ray_list, std::as_bytes(std::span(rays)));
    }

    /// `counters`: where those of rays and tiles are, before or after the arguments are prepared.
    AmdTraced result(unsigned rays, unsigned tiles) {
        const std::vector<uint32_t> counters = words(pass_list, work.counters, 4);
        return {.rays = words(pass_list, work.ray_list, counters[rays]),
                .tiles = words(pass_list, work.tile_list, counters[tiles]),
                .radiance = pass_list.download(histories.radiance.current),
                .roughness = pass_list.download(histories.roughness.current),
                .confidence = pass_list.download(confidence),
                .arguments = words(pass_list, work.indirect_arguments, 6)};
    }
};

}  // namespace

AmdTraced amd_classify_frame(Device& device, const HostGBuffer& gbuffer, const nlohmann::json& parameters,
                             const HostImage* variance) {
    TracedFrame frame(device, gbuffer, parameters);
    if (variance) frame.pass_list.upload(frame.histories.variance.previous, *variance);
    frame.classify();
    return frame.result(0, 2);
}

AmdTraced amd_trace_frame(Device& device, const HostGBuffer& gbuffer, const nlohmann::json& parameters,
                          const HostImage& noise, RayProbe* probe) {
    TracedFrame frame(device, gbuffer, parameters);
    const Image numbers = frame.pass_list.image_of("blue_noise", Format::rg32f, noise.extent);
    frame.pass_list.upload(numbers, noise);
    frame.classify();
    frame.sort_rays_by_tile();
    amd_prepare_arguments(frame.pass_list, frame.work, frame.parameters.denoiser);
    amd_intersect(frame.pass_list, frame.gbuffer, frame.images, numbers, frame.work, frame.histories,
                  frame.parameters.tracing, probe);
    return frame.result(1, 3);
}

HostImage map_of_rays(const AmdTraced& traced, glm::uvec2 extent) {
    HostImage map(extent, 1);
    for (const uint32_t ray : traced.rays) {
        const unsigned x = ray & 0x7fff, y = ray >> 15 & 0x3fff;
        if (x >= extent.x || y >= extent.y) {
            ADD_FAILURE() << "a ray at " << x << ", " << y;
            continue;
        }
        EXPECT_EQ(*map.pixel(x, y), 0) << x << ", " << y << " is listed twice";
        *map.pixel(x, y) = float(1 + 2 * (ray >> 29));
    }
    return map;
}

HostImage map_of_tiles(const AmdTraced& traced, glm::uvec2 extent) {
    HostImage map((extent + 7u) / 8u, 1);
    for (const uint32_t tile : traced.tiles) {
        const unsigned x = (tile & 0xffff) / 8, y = (tile >> 16) / 8;
        if (x >= map.extent.x || y >= map.extent.y || tile % 8 || (tile >> 16) % 8) {
            ADD_FAILURE() << "a tile at " << (tile & 0xffff) << ", " << (tile >> 16);
            continue;
        }
        EXPECT_EQ(*map.pixel(x, y), 0) << x << ", " << y << " is listed twice";
        *map.pixel(x, y) = 1;
    }
    return map;
}

std::vector<std::string> amd_tracer_sets() {
    std::vector<std::string> sets;
    for (const std::string& set : golden_sets("amd/"))
        if (is_golden(set + "/classify.exr")) sets.push_back(set);
    return sets;
}

nlohmann::json amd_golden_parameters(const std::string& set, const std::string& name) {
    static const std::map<std::string, std::string> ours = {
        {"samplesPerQuad", "samples_per_quad"},
        {"temporalVarianceGuidedTracingEnabled", "guided_tracing"},
        {"minTraversalOccupancy", "hierarchy.min_traversal_occupancy"},
        {"depthBufferThickness", "hierarchy.depth_buffer_thickness"},
        {"mostDetailedMip", "hierarchy.most_detailed_mip"},
        {"maxTraversalIntersections", "hierarchy.max_traversal_intersections"},
        {"roughnessThreshold (alpha)", "roughness_threshold_alpha"}};
    const nlohmann::json recorded = golden_meta(set)["parameter_sets"][name]["parameters"];
    nlohmann::json parameters;
    for (const auto& [key, value] : recorded.items()) {
        if (!ours.contains(key)) fail(set, "/meta.json: unknown parameter '", key, "'");
        parameters[ours.at(key)] = key == "temporalVarianceGuidedTracingEnabled" ? nlohmann::json(value != 0) : value;
    }
    return parameters;
}
