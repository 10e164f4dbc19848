#include "core/exr/exr_pixels.h"

#include "core/error.h"
#include "core/exr/exr_colors.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfRgbaFile.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fs = std::filesystem;

namespace {

/// The rows of the data window that lie in the display window, and whether its columns do, so that rows can be decoded
/// into the picture itself.
struct Overlap {
    explicit Overlap(const ExrPart& part)
        : first_row(std::max(part.data.min.y, part.display.min.y)),
          last_row(std::min(part.data.max.y, part.display.max.y)),
          first_column(std::max(part.data.min.x, part.display.min.x)),
          last_column(std::min(part.data.max.x, part.display.max.x)),
          is_within(part.data.min.x >= part.display.min.x && part.data.max.x <= part.display.max.x) {}

    bool is_empty() const { return first_row > last_row || first_column > last_column; }
    size_t rows() const { return size_t(int64_t(last_row) - first_row + 1); }

    int first_row, last_row, first_column, last_column;
    bool is_within;
};

/// Values that rows are decoded into: those of the picture, or of rows as wide as the data window.
template <class Value>
struct Rows {
    std::vector<Value> own;
    Value* values;
    size_t width, channels;
    glm::i64vec2 origin;  ///< the pixel that comes first

    Rows(std::vector<Value>& picture, const ExrPart& part, const Overlap& overlap, size_t channels)
        : channels(channels) {
        if (overlap.is_within) {
            width = size_t(part.display.extent().x), origin = part.display.min, values = picture.data();
        } else {
            width = size_t(part.data.extent().x), origin = {part.data.min.x, overlap.first_row};
            own.resize(width * overlap.rows() * channels), values = own.data();
        }
    }

    Imf::Slice slice(Imf::PixelType type, size_t channel) const {
        const ptrdiff_t stride = ptrdiff_t(channels * sizeof(Value)), row = stride * ptrdiff_t(width);
        char* first = reinterpret_cast<char*>(values + channel);
        return {type, first - origin.x * stride - origin.y * row, size_t(stride), size_t(row)};
    }

    /// Calls `copy` with the place in these rows and the index in the picture, for each pixel that both have.
    template <class Copy>
    void for_overlap(const ExrPart& part, const Overlap& overlap, const Copy& copy) const {
        const auto picture_width = size_t(part.display.extent().x);
        for (int64_t y = overlap.first_row; y <= overlap.last_row; ++y)
            for (int64_t x = overlap.first_column; x <= overlap.last_column; ++x)
                copy(values + (size_t(y - origin.y) * width + size_t(x - origin.x)) * channels,
                     size_t(y - part.display.min.y) * picture_width + size_t(x - part.display.min.x));
    }

    void copy_to(std::vector<Value>& picture, const ExrPart& part, const Overlap& overlap) const {
        if (own.empty()) return;
        for_overlap(part, overlap, [&](const Value* pixel, size_t at) {
            std::copy_n(pixel, channels, picture.begin() + ptrdiff_t(at * channels));
        });
    }
};

/// Bytes that decoding a part takes beside its pixels.
double bytes_of_blocks(const ExrPart& part) {
    // OpenEXR holds one block compressed and one not; PIZ and DWA hold it in further forms.
    constexpr double copies = 6;
    const double width = std::max(part.data.extent().x, part.tile.x);
    return copies * width * part.block_lines() * double(part.channels.size()) * sizeof(float);
}

/// Sets memory aside for `channels` channels of the picture, of `bytes` each a pixel.
void set_aside(MemoryShare& memory, const fs::path& file, const ExrHeader& header, size_t part_index, size_t channels,
               double bytes) {
    constexpr double bytes_per_place = 64;  // of a block in the file, of tiles in all their sizes
    const ExrPart& part = header.parts[part_index];
    const glm::dvec2 picture = part.display.extent(), stored = part.data.extent();
    const Overlap overlap(part);
    double needed = picture.x * picture.y * bytes + bytes_of_blocks(part);
    if (!overlap.is_within && !overlap.is_empty()) needed += stored.x * double(overlap.rows()) * bytes;
    if (part.tile.y > 0) needed += stored.x * part.tile.y * bytes;  // rows of tiles become lines
    for (const ExrPart& other : header.parts) needed += other.blocks() * bytes_per_place;
    const glm::dvec2 largest = picture.x * picture.y > stored.x * stored.y ? picture : stored;
    memory.add(needed, file.string() + ": its image of " + std::to_string(size_t(largest.x)) + " x " +
                           std::to_string(size_t(largest.y)) + " pixels with " + std::to_string(channels) +
                           " channels");
}

void refuse_deep(const fs::path& file, const ExrPart& part) {
    if (part.is_deep)
        fail("cannot read ", file.string(), part.name.empty() ? "" : ": part '" + part.name + "'",
             ": its pixels are deep, lists of samples; flatten them: `oiiotool deep.exr --flatten -o flat.exr`");
}

/// What OpenEXR read of the header must be what was read here, by which memory was set aside.
void check_same(const fs::path& file, const ExrPart& part, const Imf::Header& header) {
    const auto same = [](const ExrWindow& window, const Imath::Box2i& box) {
        return window == ExrWindow{{box.min.x, box.min.y}, {box.max.x, box.max.y}};
    };
    bool is_same = same(part.data, header.dataWindow()) && same(part.display, header.displayWindow());
    for (const ExrChannel& channel : part.channels) is_same &= header.channels().findChannel(channel.name) != nullptr;
    if (!is_same) fail("cannot read ", file.string(), " as OpenEXR: its header names windows or channels twice");
}

Imf::PixelType file_type(PixelType type) { return type == PixelType::uint32 ? Imf::UINT : Imf::FLOAT; }

bool has_integers(const ExrPart& part, const ExrPlanes& planes) {
    return std::ranges::any_of(planes.channels, [&](size_t c) { return part.channels[c].type == PixelType::uint32; });
}

/// Decodes the planes of one part.
template <class Input>
void decode(Input& in, const fs::path& file, const ExrPart& part, const std::vector<ExrPlanes*>& all) {
    check_same(file, part, in.header());
    const Overlap overlap(part);
    if (overlap.is_empty()) return;
    Imf::FrameBuffer frame;
    std::vector<Rows<float>> floats;
    std::vector<Rows<uint32_t>> integers;
    for (ExrPlanes* planes : all) {
        floats.emplace_back(planes->image.values, part, overlap, planes->channels.size());
        integers.emplace_back(planes->integers, part, overlap, planes->integers.empty() ? 0 : planes->channels.size());
        for (size_t c = 0; c < planes->channels.size(); ++c) {
            const ExrChannel& channel = part.channels[planes->channels[c]];
            const bool is_integer = channel.type == PixelType::uint32;
            frame.insert(channel.name, is_integer ? integers.back().slice(Imf::UINT, c)
                                                  : floats.back().slice(file_type(channel.type), c));
        }
    }
    in.setFrameBuffer(frame);
    in.readPixels(overlap.first_row, overlap.last_row);
    for (size_t i = 0; i < all.size(); ++i) {
        floats[i].copy_to(all[i]->image.values, part, overlap);
        integers[i].copy_to(all[i]->integers, part, overlap);
        if (all[i]->integers.empty()) continue;
        const size_t channels = all[i]->channels.size();
        for (size_t c = 0; c < channels; ++c)
            if (part.channels[all[i]->channels[c]].type == PixelType::uint32)
                for (size_t at = c; at < all[i]->integers.size(); at += channels)
                    all[i]->image.values[at] = float(all[i]->integers[at]);
    }
}

/// Calls `read` with the part of the file, as OpenEXR has opened it, and makes its exceptions Errors.
template <class Read>
void with_part(const fs::path& file, const ExrHeader& header, size_t part, const Read& read) {
    try {
        if (!header.has_part_flag) {
            Imf::InputFile in(file.c_str());
            read(in);
        } else {
            Imf::MultiPartInputFile parts(file.c_str());
            if (size_t(parts.parts()) != header.parts.size())
                fail("cannot read ", file.string(), " as OpenEXR: its header is truncated or malformed");
            Imf::InputPart in(parts, int(part));
            read(in);
        }
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        fail("cannot read ", file.string(), " as OpenEXR: ", e.what());
    }
}

glm::uvec2 picture_extent(const ExrPart& part) { return glm::uvec2(part.display.extent()); }

}  // namespace

MemoryShare read_planes(const fs::path& file, const ExrHeader& header, std::span<ExrPlanes> planes) {
    MemoryShare memory;
    std::map<size_t, std::vector<ExrPlanes*>> by_part;
    for (ExrPlanes& some : planes) by_part[some.part].push_back(&some);
    for (const auto& [index, of_part] : by_part) {
        const ExrPart& part = header.parts[index];
        refuse_deep(file, part);
        size_t channels = 0, integers = 0;
        for (const ExrPlanes* some : of_part) {
            channels += some->channels.size();
            if (has_integers(part, *some)) integers += some->channels.size();
            for (const size_t c : some->channels)
                if (part.channels[c].sampling != glm::ivec2(1))
                    fail("cannot read ", file.string(), ": channel '", part.channels[c].name, "' is subsampled (",
                         part.channels[c].sampling.x, " x ", part.channels[c].sampling.y,
                         "); only chroma may be subsampled (RY, BY beside Y)");
        }
        set_aside(memory, file, header, index, channels, double(channels + integers) * sizeof(float));
    }
    for (const auto& [index, of_part] : by_part) {
        const ExrPart& part = header.parts[index];
        for (ExrPlanes* some : of_part) {
            some->image = HostImage(picture_extent(part), unsigned(some->channels.size()));
            if (has_integers(part, *some)) some->integers.resize(some->image.values.size());
        }
        with_part(file, header, index, [&](auto& in) { decode(in, file, part, of_part); });
    }
    return memory;
}

void refuse_rounding(const fs::path& file, const ExrHeader& header, const ExrPlanes& planes) {
    for (size_t i = 0; i < planes.integers.size(); ++i)
        if (uint64_t(float(planes.integers[i])) != planes.integers[i])
            fail("cannot read ", file.string(), ": channel '",
                 header.parts[planes.part].channels[planes.channels[i % planes.channels.size()]].name,
                 "' has the integer ", planes.integers[i], ", but 32-bit floats hold all integers up to 16777216 only");
}

HostImage read_luminance_chroma(const fs::path& file, const ExrHeader& header, size_t index,
                                const std::array<size_t, 3>& channels, MemoryShare& memory) {
    const ExrPart& part = header.parts[index];
    refuse_deep(file, part);
    const ExrChannel &y = part.channels[channels[0]], &ry = part.channels[channels[1]],
                     &by = part.channels[channels[2]];
    HostImage rgb;
    if (ry.sampling == glm::ivec2(1) && by.sampling == glm::ivec2(1)) {
        ExrPlanes planes{.part = index, .channels = {channels.begin(), channels.end()}};
        memory = read_planes(file, header, {&planes, 1});
        rgb = std::move(planes.image);
        // OpenEXR, "Technical Introduction", "Luminance/Chroma Images": RY = (R - Y) / Y, BY = (B - Y) / Y.
        const glm::dvec3 weights = luminance_weights(file, part);
        for (size_t i = 0; i < rgb.pixel_count(); ++i) {
            const glm::dvec3 yrb(rgb.rgb(i));
            const double r = (yrb.y + 1) * yrb.x, b = (yrb.z + 1) * yrb.x;
            rgb.set_rgb(i, glm::vec3(r, (yrb.x - r * weights.x - b * weights.z) / weights.y, b));
        }
        return rgb;
    }
    const std::string layer = y.name == "Y" ? "" : y.name.substr(0, std::max<size_t>(y.name.size(), 2) - 2);
    const std::string prefix = layer.empty() ? "" : layer + ".";
    if (index > 0 || y.name != prefix + "Y" || ry.name != prefix + "RY" || by.name != prefix + "BY")
        fail("cannot read ", file.string(), ": the chroma '", ry.name, "' and '", by.name, "' of '", y.name,
             "' is subsampled, but only Y, RY and BY of the first part may be; write R, G and B");
    set_aside(memory, file, header, index, 3, 3 * sizeof(float) + sizeof(Imf::Rgba));
    rgb = HostImage(picture_extent(part), 3);
    const Overlap overlap(part);
    try {
        Imf::RgbaInputFile in(file.c_str(), layer);
        check_same(file, part, in.header());
        if (overlap.is_empty()) return rgb;
        std::vector<Imf::Rgba> picture(overlap.is_within ? rgb.pixel_count() : 0);
        const Rows<Imf::Rgba> rows(picture, part, overlap, 1);
        in.setFrameBuffer(rows.values - rows.origin.x - rows.origin.y * int64_t(rows.width), 1, rows.width);
        in.readPixels(overlap.first_row, overlap.last_row);
        rows.for_overlap(part, overlap, [&](const Imf::Rgba* pixel, size_t at) {
            rgb.set_rgb(at, glm::vec3(pixel->r, pixel->g, pixel->b));
        });
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        fail("cannot read ", file.string(), " as OpenEXR: ", e.what());
    }
    return rgb;
}
