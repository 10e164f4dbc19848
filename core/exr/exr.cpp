#include "core/exr/exr.h"

#include "core/error.h"
#include "core/exr/exr_layers.h"
#include "core/exr/exr_picture.h"
#include "core/exr/exr_pixels.h"
#include "core/files.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

namespace {

std::string channel_name(const Layer& layer, size_t channel) {
    const std::string letter(1, layer.channel_names[channel]);
    return layer.name.empty() ? letter : layer.name + "." + letter;
}

Imf::PixelType file_type(PixelType type) {
    return type == PixelType::half ? Imf::HALF : type == PixelType::uint32 ? Imf::UINT : Imf::FLOAT;
}

}  // namespace

const Layer* LayeredImage::find(const std::string& name) const {
    const auto found = std::ranges::find(layers, name, &Layer::name);
    return found == layers.end() ? nullptr : &*found;
}

void write_exr(const std::filesystem::path& file, const LayeredImage& image) {
    if (image.layers.empty()) fail("nothing to write into ", file.string());
    const glm::uvec2 extent = image.layers.front().image.extent;
    if (extent.x == 0 || extent.y == 0) fail("cannot write ", file.string(), ": the image has zero size");

    Imf::Header header{int(extent.x), int(extent.y)};
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [name, value] : image.attributes) header.insert(name, Imf::StringAttribute(value));

    // Values are converted from interleaved float32 once per channel that is stored as something else.
    Imf::FrameBuffer frame;
    std::vector<std::vector<half>> halves;
    std::vector<std::vector<uint32_t>> integers;
    for (const Layer& layer : image.layers) {
        const HostImage& source = layer.image;
        if (source.extent != extent)
            fail("cannot write ", file.string(), ": layer '", layer.name, "' has another size");
        if (layer.channel_names.size() != source.channels)
            fail("cannot write ", file.string(), ": layer '", layer.name, "' names ", layer.channel_names.size(),
                 " channels but has ", source.channels);
        for (size_t c = 0; c < source.channels; ++c) {
            const std::string name = channel_name(layer, c);
            header.channels().insert(name, Imf::Channel(file_type(layer.type)));
            const auto value = [&](size_t i) { return source.values[i * source.channels + c]; };
            char* base;
            size_t stride;
            if (layer.type == PixelType::half) {
                auto& converted = halves.emplace_back(source.pixel_count());
                for (size_t i = 0; i < converted.size(); ++i) converted[i] = half(value(i));
                base = reinterpret_cast<char*>(converted.data()), stride = sizeof(half);
            } else if (layer.type == PixelType::uint32) {
                auto& converted = integers.emplace_back(source.pixel_count());
                for (size_t i = 0; i < converted.size(); ++i) converted[i] = uint32_t(value(i));
                base = reinterpret_cast<char*>(converted.data()), stride = sizeof(uint32_t);
            } else {
                base = reinterpret_cast<char*>(const_cast<float*>(source.values.data() + c)),
                stride = source.channels * sizeof(float);
            }
            frame.insert(name, Imf::Slice(file_type(layer.type), base, stride, stride * extent.x));
        }
    }
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        try {
            errno = 0;
            Imf::OutputFile out(temporary.c_str(), header);
            out.setFrameBuffer(frame);
            out.writePixels(int(extent.y));
        } catch (const std::exception& e) {
            fail_write(file, errno ? std::strerror(errno) : e.what());
        }
    });
}

LayeredImage read_exr(const std::filesystem::path& file) {
    const ExrHeader header = read_exr_header(file);
    const std::vector<ExrLayer> layers = layers_of(header);
    std::vector<ExrPlanes> planes;
    for (const ExrLayer& layer : layers) {
        planes.push_back({.part = layer.part, .channels = {}});
        for (const ExrComponent& component : layer.components) planes.back().channels.push_back(component.channel);
    }
    LayeredImage image{
        .layers = {}, .attributes = header.parts.front().texts, .memory = read_planes(file, header, planes)};
    for (size_t i = 0; i < layers.size(); ++i) {
        refuse_rounding(file, header, planes[i]);
        Layer layer{.name = layers[i].name, .channel_names = {}, .image = std::move(planes[i].image)};
        for (const ExrComponent& component : layers[i].components) layer.channel_names += component.letter;
        const auto is_stored_as = [&](PixelType type) {
            return std::ranges::all_of(planes[i].channels,
                                       [&](size_t c) { return header.parts[planes[i].part].channels[c].type == type; });
        };
        if (is_stored_as(PixelType::half)) layer.type = PixelType::half;
        if (is_stored_as(PixelType::uint32)) layer.type = PixelType::uint32;
        planes[i] = {};
        image.layers.push_back(std::move(layer));
    }
    return image;
}

void write_exr(const std::filesystem::path& file, const HostImage& rgb, PixelType type) {
    write_exr(file, LayeredImage{.layers = {{.name = "", .channel_names = "RGB", .image = rgb, .type = type}},
                                 .attributes = {}});
}

HostImage read_exr_rgb(const std::filesystem::path& file, const std::string& layer) {
    return read_exr_picture(file, layer).rgb;
}
