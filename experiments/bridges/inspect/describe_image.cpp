// What is understood of image files.
#include "core/decoded_image.h"
#include "core/error.h"
#include "core/exr/exr_picture.h"
#include "core/exr/exr_pixels.h"
#include "core/files.h"
#include "core/image_format.h"
#include "core/png_colors.h"
#include "core/radiance_hdr.h"
#include "experiments/bridges/inspect/channel_range.h"
#include "experiments/bridges/inspect/describe.h"

#include <cstring>
#include <limits>

namespace fs = std::filesystem;

namespace {

const char* type_name(PixelType type) {
    return type == PixelType::half ? "half" : type == PixelType::uint32 ? "uint32" : "float32";
}

/// First and last pixel, in x and y.
Description window_entry(const ExrWindow& window) { return {window.min.x, window.min.y, window.max.x, window.max.y}; }

Description part_entry(const ExrPart& part) {
    Description entry = {{"data_window", window_entry(part.data)},
                         {"display_window", window_entry(part.display)},
                         {"compression", part.compression_name()},
                         {"primaries", part.chromaticities ? name_of(*part.chromaticities) : "not named"}};
    if (part.tile.x > 0) entry["tile"] = {part.tile.x, part.tile.y};
    if (part.is_deep) entry["is_deep"] = true;
    if (!part.name.empty()) entry["name"] = part.name;
    if (!part.view.empty()) entry["view"] = part.view;
    for (const auto& [name, text] : part.texts) entry["attributes"][name] = text;
    return entry;
}

/// Adds all channels of a part, with the ranges of those that have a value for each pixel.
void add_channels(const fs::path& file, const ExrHeader& header, size_t index, bool reads_pixels,
                  Description& channels) {
    const ExrPart& part = header.parts[index];
    ExrPlanes planes{.part = index, .channels = {}};
    for (size_t c = 0; c < part.channels.size(); ++c)
        if (reads_pixels && part.channels[c].sampling == glm::ivec2(1) && !part.is_deep) planes.channels.push_back(c);
    MemoryShare memory;
    if (!planes.channels.empty()) memory = read_planes(file, header, {&planes, 1});
    unsigned plane = 0;
    for (size_t c = 0; c < part.channels.size(); ++c) {
        const ExrChannel& channel = part.channels[c];
        Description entry = {{"name", (part.name.empty() ? "" : part.name + ".") + channel.name},
                             {"type", type_name(channel.type)}};
        if (part.is_lossy(channel)) entry["is_lossy"] = true;
        if (channel.sampling != glm::ivec2(1)) entry["sampling"] = {channel.sampling.x, channel.sampling.y};
        if (plane < planes.channels.size() && planes.channels[plane] == c)
            entry.update(to_json(channel_range(planes.image, plane++)));
        channels.push_back(std::move(entry));
    }
}

/// Which channels commands take as the colours, and what they say of it; or why none.
Description picture_entry(const fs::path& file, const ExrHeader& header) {
    using Kind = ExrPictureSource::Kind;
    try {
        std::vector<std::string> notes;
        const ExrPictureSource source = exr_picture_source(file, header, "", notes);
        const ExrPart& part = header.parts[source.layer.part];
        Description channels = Description::array();
        for (const ExrComponent& component : source.components)
            channels.push_back(part.channels[component.channel].name);
        const bool is_converted = (source.kind == Kind::rgb || source.kind == Kind::luminance_chroma) &&
                                  part.chromaticities && !is_rec709(*part.chromaticities);
        return {{"channels", channels},
                {"colors",
                 is_converted ? "linear Rec. 709, converted from " + name_of(*part.chromaticities) : "linear Rec. 709"},
                {"notes", notes}};
    } catch (const MachineError&) {
        throw;
    } catch (const Error& e) {
        return {{"refusal", e.what()}};
    }
}

/// Codes as they are stored, in [0, 1].
HostImage stored_codes(const DecodedImage& decoded) {
    HostImage codes(decoded.extent, 4);
    for (size_t i = 0; i < codes.values.size(); ++i) {
        uint16_t wide = 0;
        if (decoded.channel_bytes == 2) std::memcpy(&wide, &decoded.rgba[2 * i], sizeof wide);
        codes.values[i] = decoded.channel_bytes == 2 ? float(wide) / 65535.0f : float(decoded.rgba[i]) / 255.0f;
    }
    return codes;
}

Description image_entry(const fs::path& file, const char* format, glm::uvec2 extent) {
    return {{"kind", "image"}, {"file", file.string()}, {"format", format}, {"width", extent.x}, {"height", extent.y}};
}

Description channel_entries(const HostImage& image, const char* names, const char* type) {
    Description channels = Description::array();
    for (unsigned c = 0; c < image.channels; ++c) {
        Description channel = {{"name", std::string(1, names[c])}, {"type", type}};
        channel.update(to_json(channel_range(image, c)));
        channels.push_back(std::move(channel));
    }
    return channels;
}

Description describe_codes(const fs::path& file, ImageFormat format) {
    const std::string bytes = read_text(file);
    const EncodedImage encoded{
        {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, file.string(), file.string()};
    const DecodedImage decoded = decode_image(encoded, std::numeric_limits<unsigned>::max());
    MemoryShare memory;
    memory.add(double(decoded.extent.x) * double(decoded.extent.y) * sizeof(glm::vec4), file.string() + ": its codes");
    Description entry = image_entry(file,
                                    format == ImageFormat::png    ? "PNG"
                                    : format == ImageFormat::jpeg ? "JPEG"
                                                                  : "WebP",
                                    decoded.extent);
    entry["stored"] = decoded.stored;
    entry["channels"] = channel_entries(stored_codes(decoded), "RGBA", "code");
    entry["colors"] = "sRGB; codes are shown as stored, in [0, 1]";
    Description notes = decoded.warnings;
    if (format == ImageFormat::png) try {
            if (const std::string note = png_colors(encoded).note; !note.empty()) {
                notes.push_back(note);
                entry["colors"] = "not sRGB; codes are shown as stored, in [0, 1]";
            }
        } catch (const MachineError&) {
            throw;
        } catch (const Error& e) {
            notes.push_back(e.what());
            entry["colors"] = "cannot be used: see the notes";
        }
    if (entry["channels"][3]["least"] < 1.0)
        notes.push_back("the alpha channel is not opaque; comparisons use the stored colours");
    entry["notes"] = notes;
    return entry;
}

}  // namespace

Description describe_exr(const fs::path& file, bool reads_pixels) {
    const ExrHeader header = read_exr_header(file);
    const glm::dvec2 extent = header.parts.front().display.extent();
    Description entry = image_entry(file, "OpenEXR", glm::uvec2(0));
    entry["width"] = uint64_t(extent.x), entry["height"] = uint64_t(extent.y);
    entry["parts"] = Description::array(), entry["channels"] = Description::array();
    for (const ExrPart& part : header.parts) entry["parts"].push_back(part_entry(part));
    entry["picture"] = picture_entry(file, header);
    for (size_t i = 0; i < header.parts.size(); ++i) add_channels(file, header, i, reads_pixels, entry["channels"]);
    return entry;
}

Description describe_image(const fs::path& file) {
    const ImageFormat format = image_format(first_bytes(file));
    if (format == ImageFormat::exr) return describe_exr(file);
    if (format != ImageFormat::radiance) return describe_codes(file, format);
    std::vector<std::string> notes;
    const HostImage rgb = read_radiance_hdr(file, notes);
    Description entry = image_entry(file, "Radiance", rgb.extent);
    entry["colors"] = "linear Rec. 709";
    entry["channels"] = channel_entries(rgb, "RGB", "RGBE");
    entry["notes"] = notes;
    return entry;
}
