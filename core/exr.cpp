#include "core/exr.h"

#include "core/error.h"
#include "core/files.h"
#include "core/near_miss.h"
#include "core/reading_limits.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>

namespace {

std::string channel_name(const Layer& layer, size_t channel) {
    const std::string letter(1, layer.channel_names[channel]);
    return layer.name.empty() ? letter : layer.name + "." + letter;
}

Imf::PixelType file_type(PixelType type) {
    return type == PixelType::half ? Imf::HALF : type == PixelType::uint32 ? Imf::UINT : Imf::FLOAT;
}

/// RGBA and XYZ before all else, so that an interleaved image has the order which its user expects.
int channel_rank(char letter) {
    const size_t rank = std::string_view("RGBAXYZ").find(letter);
    return rank == std::string_view::npos ? 1000 + letter : int(rank);
}

/// What an image takes by its header, which is read here since OpenEXR sets memory aside while it reads that.
struct Announced {
    double width = 0, height = 0, tile_width = 0, tile_height = 0;  ///< pixels; tiles: 0 of scan lines
    size_t channels = 0;
};

constexpr size_t channel_bytes = 16;  ///< of a channel in the file's list, after its name

/// Whether an attribute is as long as its type makes it. OpenEXR reads attributes of the types that it knows without
/// looking at the length that stands before them, so that one of another length has it take what follows for lengths of
/// further attributes, and set memory aside for those.
bool has_length_of_its_type(const std::string& type, const std::string& value) {
    // clang-format off
    static const std::map<std::string_view, size_t> lengths = {
        {"compression", 1}, {"deepImageState", 1}, {"envmap", 1}, {"lineOrder", 1}, {"float", 4}, {"int", 4}, {"double", 8},
        {"rational", 8}, {"timecode", 8}, {"tiledesc", 9}, {"keycode", 28}, {"chromaticities", 32}, {"box2f", 16}, {"box2i", 16},
        {"v2f", 8}, {"v2i", 8}, {"v2d", 16}, {"v3f", 12}, {"v3i", 12}, {"v3d", 24}, {"m33f", 36}, {"m44f", 64}, {"m33d", 72},
        {"m44d", 128}};
    // clang-format on
    const auto integer = [&](size_t at) {
        uint32_t number = 0;
        std::memcpy(&number, value.data() + at, sizeof number);
        return size_t(number);
    };
    if (const auto found = lengths.find(type); found != lengths.end()) return value.size() == found->second;
    if (type == "floatvector") return value.size() % sizeof(float) == 0;
    if (type == "preview") return value.size() >= 8 && value.size() == 8 + 4 * integer(0) * integer(4);
    size_t at = 0;
    if (type == "stringvector") {
        while (at + 4 <= value.size()) at += 4 + integer(at);
        return at == value.size();
    }
    if (type == "chlist") {
        while (at < value.size() && value[at] != 0) {
            at = value.find('\0', at);
            if (at == std::string::npos) return false;
            at += 1 + channel_bytes;
        }
        return at + 1 == value.size();
    }
    return true;  // text, and what OpenEXR does not know and takes as it is
}

/// Reads the header of the OpenEXR file format (openexr.com, "OpenEXR File Layout"): a magic number, a version, and
/// attributes, each a name, a type, a size and so many bytes. None if it is no such header.
std::optional<Announced> read_announced(std::ifstream& in, uintmax_t file_size, const std::string& name) {
    const auto integer = [&] {
        int32_t value = 0;  // little-endian, as all machines that ssrlab runs on
        in.read(reinterpret_cast<char*>(&value), sizeof value);
        return value;
    };
    const auto text = [&] {
        constexpr size_t longest = 255;
        std::string result;
        for (char c; in.get(c) && c != 0 && result.size() <= longest;) result += c;
        return result;
    };
    constexpr int32_t magic = 20000630, tiled = 0x200, long_names = 0x400, version = 2;
    if (integer() != magic) return {};
    const int32_t kind = integer();
    if ((kind & ~(tiled | long_names)) != version)
        fail("cannot read ", name,
             ": it is no plain OpenEXR image of version 2 (parts, deep pixels); write it as a single part");
    Announced image;
    for (std::string attribute = text(); in && !attribute.empty(); attribute = text()) {
        const std::string type = text();
        const auto size = uint32_t(integer());
        const std::streamoff begin = in.tellg();
        if (!in || uintmax_t(begin) + size > file_size) return {};
        std::string value(size, '\0');
        in.read(value.data(), size);
        if (!in || !has_length_of_its_type(type, value)) return {};
        const auto number = [&](size_t index) {
            int32_t result = 0;
            std::memcpy(&result, value.data() + index * sizeof result, sizeof result);
            return result;
        };
        if (type == "chlist") {
            for (size_t at = 0; value[at] != 0; ++image.channels) at = value.find('\0', at) + 1 + channel_bytes;
        } else if (attribute == "dataWindow" && type == "box2i") {
            image.width = double(number(2)) - number(0) + 1, image.height = double(number(3)) - number(1) + 1;
        } else if (attribute == "tiles" && type == "tiledesc") {
            image.tile_width = uint32_t(number(0)), image.tile_height = uint32_t(number(1));
        }
    }
    return in && image.width > 0 && image.height > 0 ? std::optional(image) : std::nullopt;
}

/// Sets the image's memory aside before any of it is taken.
MemoryShare announced_memory(const std::filesystem::path& file) {
    check_regular_file(file);
    std::ifstream in(file, std::ios::binary);
    const auto image = read_announced(in, std::filesystem::file_size(file), file.string());
    if (!image) fail("cannot read ", file.string(), " as OpenEXR: its header is truncated or malformed");
    constexpr double most_lines = 256;      // of a block of any compression; OpenEXR holds one compressed, and one not
    constexpr double bytes_per_place = 64;  // of a block in the file, of tiles in all their sizes
    const double block_lines = std::max(std::min(most_lines, image->height), image->tile_height),
                 block_width = std::max(image->width, image->tile_width),
                 blocks =
                     image->tile_width > 0 && image->tile_height > 0
                         ? std::ceil(image->width / image->tile_width) * std::ceil(image->height / image->tile_height)
                         : image->height;
    MemoryShare memory;
    memory.add(
        (image->width * image->height + 2 * block_width * block_lines) * double(image->channels * sizeof(float)) +
            blocks * bytes_per_place,
        file.string() + ": its image of " + std::to_string(size_t(image->width)) + " x " +
            std::to_string(size_t(image->height)) + " pixels with " + std::to_string(image->channels) + " channels");
    return memory;
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
            fail_machine("cannot write ", file.string(), ": ", errno ? std::strerror(errno) : e.what());
        }
    });
}

LayeredImage read_exr(const std::filesystem::path& file) {
    LayeredImage image{.layers = {}, .attributes = {}, .memory = announced_memory(file)};
    try {
        Imf::InputFile in(file.c_str());
        const Imf::Header& header = in.header();
        const auto window = header.dataWindow();
        const glm::uvec2 extent(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);

        for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
            if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
                image.attributes[attribute.name()] = text->value();

        for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
            const std::string name = channel.name();
            if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
                fail("cannot read ", file.string(), ": channel '", name, "' is subsampled, which is not supported");
            const size_t dot = name.rfind('.');
            const std::string layer_name = dot == std::string::npos ? "" : name.substr(0, dot);
            auto layer = std::ranges::find(image.layers, layer_name, &Layer::name);
            if (layer == image.layers.end())
                layer =
                    image.layers.insert(layer, Layer{.name = layer_name, .channel_names = {}, .image = {}, .type = {}});
            const std::string letter = dot == std::string::npos ? name : name.substr(dot + 1);
            if (letter.size() != 1)
                fail("cannot read ", file.string(), ": channel '", name, "' does not end in a single letter");
            layer->channel_names += letter;
            const Imf::PixelType type = channel.channel().type;
            layer->type = type == Imf::HALF   ? PixelType::half
                          : type == Imf::UINT ? PixelType::uint32
                                              : PixelType::float32;
        }

        Imf::FrameBuffer frame;
        for (Layer& layer : image.layers) {
            std::ranges::sort(layer.channel_names, {}, channel_rank);
            const unsigned channels = unsigned(layer.channel_names.size());
            layer.image = HostImage(extent, channels);
            const size_t stride = channels * sizeof(float);
            const ptrdiff_t origin = ptrdiff_t(window.min.y) * ptrdiff_t(extent.x) + window.min.x;
            for (size_t c = 0; c < channels; ++c)
                frame.insert(channel_name(layer, c), Imf::Slice(Imf::FLOAT,
                                                                reinterpret_cast<char*>(layer.image.values.data() + c) -
                                                                    origin * ptrdiff_t(stride),
                                                                stride, stride * extent.x));
        }
        in.setFrameBuffer(frame);
        in.readPixels(window.min.y, window.max.y);
        return image;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        fail("cannot read ", file.string(), " as OpenEXR: ", e.what());
    }
}

void write_exr(const std::filesystem::path& file, const HostImage& rgb, PixelType type) {
    write_exr(file, LayeredImage{.layers = {{.name = "", .channel_names = "RGB", .image = rgb, .type = type}},
                                 .attributes = {}});
}

HostImage read_exr_rgb(const std::filesystem::path& file, const std::string& name) {
    LayeredImage all = read_exr(file);
    const Layer* layer = all.find(name);
    const bool is_single = all.layers.size() == 1;
    if (!layer && is_single && (name.empty() || all.layers.front().name.empty())) layer = &all.layers.front();
    if (!layer && name.empty()) layer = all.find("image");
    if (!layer) {
        std::vector<std::string> names;
        for (const Layer& l : all.layers) names.push_back(l.name);
        if (name.empty())
            fail(file.string(), " has several layers, none of them without a name", suggestion("", names));
        fail(file.string(), " has no layer '", name, "'", suggestion(name, names));
    }
    const HostImage& source = layer->image;
    if (source.channels == 2) fail(file.string(), ": layer '", layer->name, "' has two channels, not a colour");
    all.memory.add(double(source.pixel_count()) * sizeof(glm::vec3), file.string() + ": its colours");
    HostImage rgb(source.extent, 3);
    for (size_t i = 0; i < rgb.pixel_count(); ++i)
        for (unsigned c = 0; c < 3; ++c)
            rgb.values[i * 3 + c] = source.values[i * source.channels + (source.channels == 1 ? 0 : c)];
    return rgb;
}
