#include "core/exr/exr_header.h"

#include "core/error.h"
#include "core/image_format.h"
#include "core/reading_limits.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

namespace {

constexpr size_t channel_bytes = 16;  ///< of a channel in the file's list, after its name

template <class Value>
Value value_at(const std::string& bytes, size_t at) {
    Value value{};
    std::memcpy(&value, bytes.data() + at, sizeof value);  // little-endian, as all machines that ssrlab runs on
    return value;
}

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
    const auto integer = [&](size_t at) { return size_t(value_at<uint32_t>(value, at)); };
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

/// The channels of a list whose length is right. None if one has a type that there is not.
std::optional<std::vector<ExrChannel>> read_channels(const std::string& list) {
    constexpr PixelType types[] = {PixelType::uint32, PixelType::half, PixelType::float32};  // as the file numbers them
    std::vector<ExrChannel> channels;
    for (size_t at = 0; list[at] != 0;) {
        ExrChannel channel{.name = std::string(list.c_str() + at)};
        at += channel.name.size() + 1;
        const auto type = value_at<uint32_t>(list, at);
        if (type >= std::size(types)) return {};
        channel.type = types[type];
        channel.sampling = {value_at<int32_t>(list, at + 8), value_at<int32_t>(list, at + 12)};
        channels.push_back(std::move(channel));
        at += channel_bytes;
    }
    return channels;
}

ExrWindow read_window(const std::string& value) {
    return {{value_at<int32_t>(value, 0), value_at<int32_t>(value, 4)},
            {value_at<int32_t>(value, 8), value_at<int32_t>(value, 12)}};
}

/// Reads the attributes of one part after the other: each a name, a type, a size and so many bytes; an empty name ends
/// a part.
class HeaderReader {
public:
    HeaderReader(const std::filesystem::path& file)
        : name_(file.string()), in_(file, std::ios::binary), size_(std::filesystem::file_size(file)) {}

    ExrHeader read() {
        constexpr int32_t magic = 20000630, version = 2, version_bits = 0xff;
        constexpr int32_t tiled = 0x200, long_names = 0x400, deep = 0x800, several_parts = 0x1000;
        if (integer() != magic) refuse_other_format();
        const int32_t kind = integer();
        if ((kind & version_bits) != version && in_)
            fail("cannot read ", name_, ": it is of version ", kind & version_bits, " of OpenEXR's file layout; only ",
                 version, " is read");
        if ((kind & ~(version_bits | tiled | long_names | deep | several_parts)) != 0) malformed();
        ExrHeader header;
        header.has_part_flag = (kind & several_parts) != 0;
        for (std::string attribute = text(); !attribute.empty(); attribute = header.has_part_flag ? text() : "") {
            if (header.parts.size() == most_parts)
                fail("cannot read ", name_, ": it has more than ", most_parts, " parts");
            ExrPart& part = header.parts.emplace_back();
            part.is_deep = (kind & deep) != 0 && !header.has_part_flag;
            read_part(part, attribute);
        }
        if (header.parts.empty()) malformed();
        return header;
    }

private:
    static constexpr size_t most_parts = 10'000;  // each costs OpenEXR some kilobytes

    [[noreturn]] void malformed() const {
        fail("cannot read ", name_, " as OpenEXR: its header is truncated or malformed");
    }

    /// The file does not begin as OpenEXR's do.
    [[noreturn]] void refuse_other_format() const {
        const std::vector<uint8_t> bytes = first_bytes(name_);
        std::string why = why_unreadable(bytes, name_, ImageUse::radiance);
        if (image_format(bytes) == ImageFormat::radiance)
            why = "is a Radiance picture; convert it: oiiotool " + quoted_for_shell(name_) + " -d float -o OUT.exr";
        if (why.empty()) malformed();
        fail("cannot read ", name_, " as OpenEXR: it ", why);
    }

    int32_t integer() {
        int32_t value = 0;
        in_.read(reinterpret_cast<char*>(&value), sizeof value);
        return value;
    }

    std::string text() {
        constexpr size_t longest = 255;
        std::string result;
        for (char c; in_.get(c) && c != 0 && result.size() <= longest;) result += c;
        return result;
    }

    void read_part(ExrPart& part, std::string attribute) {
        std::string type_of_part, first_view;
        double chunks = 0;
        bool has_display = false, has_data = false, has_tiles = false;
        for (; in_ && !attribute.empty(); attribute = text()) {
            const std::string type = text();
            const auto size = uint32_t(integer());
            const std::streamoff begin = in_.tellg();
            if (!in_ || uintmax_t(begin) + size > size_) malformed();
            std::string value(size, '\0');
            in_.read(value.data(), size);
            if (!in_ || !has_length_of_its_type(type, value)) malformed();
            if (type == "chlist" && attribute == "channels") {
                auto channels = read_channels(value);
                if (!channels) malformed();
                part.channels = std::move(*channels);
            } else if (type == "box2i" && attribute == "dataWindow") {
                part.data = read_window(value), has_data = true;
            } else if (type == "box2i" && attribute == "displayWindow") {
                part.display = read_window(value), has_display = true;
            } else if (type == "tiledesc" && attribute == "tiles") {
                part.tile = {value_at<uint32_t>(value, 0), value_at<uint32_t>(value, 4)}, has_tiles = true;
            } else if (type == "compression" && attribute == "compression") {
                part.compression = uint8_t(value[0]);
            } else if (type == "chromaticities" && attribute == "chromaticities") {
                const auto place = [&](size_t at) {
                    return glm::dvec2(value_at<float>(value, 8 * at), value_at<float>(value, 8 * at + 4));
                };
                part.chromaticities = {place(0), place(1), place(2), place(3)};
            } else if (type == "int" && attribute == "chunkCount") {
                chunks = value_at<uint32_t>(value, 0);
            } else if (type == "stringvector" && attribute == "multiView" && value.size() >= 4) {
                first_view = value.substr(4, value_at<uint32_t>(value, 0));
            } else if (type == "string") {
                part.texts[attribute] = value;
            }
        }
        const auto text_of = [&](const char* key) {
            const auto found = part.texts.find(key);
            return found == part.texts.end() ? "" : found->second;
        };
        part.name = text_of("name"), part.view = text_of("view"), type_of_part = text_of("type");
        if (part.view.empty()) part.view = first_view;
        part.is_deep |= type_of_part == "deepscanline" || type_of_part == "deeptile";
        const bool is_known = type_of_part.empty() || type_of_part == "scanlineimage" || type_of_part == "tiledimage";
        if (!is_known && !part.is_deep) part.unknown_blocks = chunks;
        const auto is_window = [](const ExrWindow& w) {
            constexpr int farthest = 1 << 30;  // OpenEXR reads no window that reaches farther
            const auto is_near = [](glm::ivec2 p) {
                return p.x > -farthest && p.x < farthest && p.y > -farthest && p.y < farthest;
            };
            return is_near(w.min) && is_near(w.max) && w.extent().x > 0 && w.extent().y > 0;
        };
        if (!in_ || !has_data || !has_display || !is_window(part.data) || !is_window(part.display) ||
            part.channels.empty() || (has_tiles && !(part.tile.x > 0 && part.tile.y > 0)))
            malformed();
    }

    std::string name_;
    std::ifstream in_;
    uintmax_t size_;
};

struct Compression {
    const char* name;
    double lines;  ///< that are compressed together
};
constexpr Compression compressions[] = {{"none", 1},   {"RLE", 1},  {"ZIPS", 1},  {"ZIP", 16},  {"PIZ", 32},
                                        {"PXR24", 16}, {"B44", 32}, {"B44A", 32}, {"DWAA", 32}, {"DWAB", 256}};

}  // namespace

std::string shown(const ExrWindow& w) {
    return std::to_string(w.min.x) + ".." + std::to_string(w.max.x) + " x " + std::to_string(w.min.y) + ".." +
           std::to_string(w.max.y);
}

double ExrPart::block_lines() const {
    if (tile.y > 0) return tile.y;
    return std::min(data.extent().y, compression < std::size(compressions) ? compressions[compression].lines : 256);
}

double ExrPart::blocks() const {
    const glm::dvec2 extent = data.extent();
    const double known = tile.x > 0 ? std::ceil(extent.x / tile.x) * std::ceil(extent.y / tile.y) : extent.y;
    return std::max(known, unknown_blocks);
}

const char* ExrPart::compression_name() const {
    return compression < std::size(compressions) ? compressions[compression].name : "unknown";
}

bool ExrPart::is_lossy(const ExrChannel& channel) const {
    const std::string_view by = compression_name();
    if (by == "PXR24") return channel.type == PixelType::float32;
    if (by == "B44" || by == "B44A") return channel.type == PixelType::half;
    if (by != "DWAA" && by != "DWAB") return false;
    if (channel.type == PixelType::uint32) return false;
    const std::string last = channel.name.substr(channel.name.rfind('.') + 1);
    constexpr std::string_view colours[] = {"R", "G", "B", "Y", "RY", "BY"};  // in capitals: ImfDwaCompressor.cpp
    return std::ranges::find(colours, last) != std::end(colours);
}

const char* ExrPart::loss() const {
    const std::string_view by = compression_name();
    if (by == "PXR24") return "rounds 32-bit floats to 24 bits";
    if (by == "B44" || by == "B44A") return "stores 16 half floats in 14 bytes";  // ImfB44Compressor.cpp
    if (by == "DWAA" || by == "DWAB")  // converts to half before it transforms
        return "takes the channels R, G, B and Y for colours, changes them, and cuts them off at 65504";
    return "";
}

ExrHeader read_exr_header(const std::filesystem::path& file) {
    check_regular_file(file);
    return HeaderReader(file).read();
}
