#include "tests/variants/amd_denoiser_bench.h"

#include <algorithm>

namespace {

unsigned channels_of(Format format) {
    switch (format) {
        case Format::rgba16f:
        case Format::rgba32f:
            return 4;
        case Format::r11g11b10f:
            return 3;
        default:
            return 1;
    }
}

}  // namespace

HostImage resized_channels(const HostImage& image, unsigned channels) {
    HostImage result(image.extent, channels);
    for (size_t i = 0; i < image.pixel_count(); ++i)
        for (unsigned c = 0; c < std::min(channels, image.channels); ++c)
            result.values[i * channels + c] = image.values[i * image.channels + c];
    return result;
}

AmdDenoiserBench::AmdDenoiserBench(Device& device, glm::uvec2 extent, const nlohmann::json& parameters)
    : pass_list(device, extent) {
    params.assign(parameters);
    const size_t tiles = size_t((extent.x + 7) / 8) * ((extent.y + 7) / 8);
    work = {.ray_list = {},
            .tile_list = pass_list.buffer("tiles", 4 * tiles),
            .counters = pass_list.buffer("counters", 16),
            .indirect_arguments = pass_list.buffer("arguments", 36)};
}

void AmdDenoiserBench::begin_frame(const DenoiserInputs& frame, const DenoiserInputs* before) {
    const auto input = [&](const char* name, Format format, const HostImage& pixels) {
        const Image image = pass_list.image(name, format);
        pass_list.upload(image, pixels);
        return image;
    };
    gbuffer.depth = input("depth", Format::r32f, frame.depth);
    gbuffer.normal = input("normal", Format::rgba32f, frame.normal);
    gbuffer.motion = input("motion", Format::rg32f, frame.motion);
    gbuffer.previous_depth =
        input("previous_depth", Format::r32f, before ? before->depth : HostImage(pass_list.extent(), 1));
    gbuffer.previous_normal =
        input("previous_normal", Format::rgba32f, before ? before->normal : HostImage(pass_list.extent(), 4));
    pass_list.begin_frame(frame.camera, params, std::vector{gbuffer.depth, gbuffer.normal, gbuffer.motion});
    histories = amd_histories(pass_list, denoiser.float_histories, false);
    upload(histories.radiance.current, frame.radiance);
    pass_list.upload(histories.roughness.current, frame.roughness);
    pass_list.upload(histories.roughness.previous, before ? before->roughness : HostImage(pass_list.extent(), 1));

    std::vector<uint32_t> list;
    for (uint32_t y = 0; y < frame.tiles.extent.y; ++y)
        for (uint32_t x = 0; x < frame.tiles.extent.x; ++x)
            if (*frame.tiles.pixel(x, y) > 0) list.push_back(8 * y << 16 | 8 * x);
    const uint32_t count = uint32_t(list.size());
    const uint32_t arguments[9] = {0, 0, 1, count, 1, 1, (count + 7) / 8, 1, 1}, counters[4] = {0, 0, 0, count};
    pass_list.upload(work.counters, std::as_bytes(std::span(counters)));
    pass_list.upload(work.tile_list, std::as_bytes(std::span(list)));
    pass_list.upload(work.indirect_arguments, std::as_bytes(std::span(arguments)));
}

void AmdDenoiserBench::upload(const Image& image, const HostImage& pixels) {
    pass_list.upload(image, resized_channels(pixels, channels_of(image.format)));
}

void AmdDenoiserBench::fill(const Image& image, glm::vec4 value) { pass_list.clear(image, value); }
