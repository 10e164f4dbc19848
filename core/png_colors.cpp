#include "core/png_colors.h"

#include "core/chromaticities.h"
#include "core/digits.h"
#include "core/error.h"
#include "core/icc_profile.h"
#include "core/near_miss.h"
#include "core/png.h"

#include <zlib.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace {

using Bytes = std::span<const uint8_t>;
using Curve = std::function<double(double)>;  ///< of a code in [0, 1]: light

uint32_t integer_at(Bytes bytes, size_t at) {
    return uint32_t(bytes[at]) << 24 | uint32_t(bytes[at + 1]) << 16 | uint32_t(bytes[at + 2]) << 8 | bytes[at + 3];
}

/// The data of each chunk before the first IDAT, the first of a type. A chunk is the length of its data, a type, the
/// data and a checksum, of four bytes each but the data (section 5.3).
std::map<std::string, Bytes> chunks_before_pixels(Bytes file) {
    constexpr size_t signature = 8, around_data = 12;
    std::map<std::string, Bytes> chunks;
    for (size_t at = signature; at + around_data <= file.size();) {
        const size_t length = integer_at(file, at);
        if (length > file.size() - at - around_data) break;
        const std::string type(file.begin() + ptrdiff_t(at) + 4, file.begin() + ptrdiff_t(at) + 8);
        if (type == "IDAT") break;
        chunks.emplace(type, file.subspan(at + 8, length));
        at += around_data + length;
    }
    return chunks;
}

double srgb_curve(double code) { return linear_from_srgb(code); }

/// ITU-T H.273, table 3, values 1, 6, 14 and 15: the inverse of a camera's curve.
double video_curve(double code) { return code < 0.081 ? code / 4.5 : std::pow((code + 0.099) / 1.099, 1 / 0.45); }

Curve power(double exponent) {
    return [exponent](double code) { return std::pow(code, exponent); };
}

/// None where the primaries span no space of colours.
std::optional<std::function<void(std::span<glm::vec3>)>> conversion(const Curve& curve, const Chromaticities& space) {
    const std::optional<glm::dmat3> matrix = is_rec709(space) ? glm::dmat3(1.0) : rec709_from(space);
    if (!matrix) return {};
    return [curve, rec709 = *matrix](std::span<glm::vec3> row) {
        for (glm::vec3& color : row)
            color = glm::vec3(rec709 * glm::dvec3(curve(color.x), curve(color.y), curve(color.z)));
    };
}

struct NamedSpace {
    const char* name;
    Chromaticities chromaticities;
};

/// ITU-T H.273, table 2. Without 10, CIE XYZ, whose primaries are no colours.
const std::map<unsigned, NamedSpace> video_spaces = {
    {1, {"BT.709", rec709_chromaticities}},
    {4, {"BT.470 M", {{0.67, 0.33}, {0.21, 0.71}, {0.14, 0.08}, {0.310, 0.316}}}},
    {5, {"BT.470 BG", {{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}}}},
    {6, {"SMPTE 170M", {{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, {0.3127, 0.3290}}}},
    {7, {"SMPTE 240M", {{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, {0.3127, 0.3290}}}},
    {8, {"generic film", {{0.681, 0.319}, {0.243, 0.692}, {0.145, 0.049}, {0.310, 0.316}}}},
    {9, {"BT.2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}}}},
    {11, {"DCI P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.314, 0.351}}}},
    {12, {"Display P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}}}},
    {22, {"EBU Tech 3213", {{0.630, 0.340}, {0.295, 0.605}, {0.155, 0.077}, {0.3127, 0.3290}}}}};

std::optional<Curve> video_transfer(unsigned number) {
    switch (number) {
        case 1:
        case 6:
        case 14:
        case 15:
            return video_curve;
        case 4:
            return power(2.2);
        case 5:
            return power(2.8);
        case 8:
            return power(1);
        case 13:
            return srgb_curve;
        default:
            return {};
    }
}

/// cICP (section 11.3.2.6): the numbers of ITU-T H.273 for primaries, curve and matrix, and whether all codes are used.
std::optional<PngColors> of_cicp(Bytes cicp, const EncodedImage& file) {
    constexpr unsigned unspecified = 2, srgb = 13, pq = 16, hlg = 18;
    if (cicp.size() != 4 || cicp[0] == unspecified || cicp[1] == unspecified) return {};
    const std::string numbers = std::to_string(cicp[0]) + " " + std::to_string(cicp[1]) + " " +
                                std::to_string(cicp[2]) + " " + std::to_string(cicp[3]);
    const auto refuse = [&](const std::string& why) {
        fail(file.what, ": its chunk cICP (", numbers, ") says ", why,
             "; save it as sRGB, or its linear light as OpenEXR, with the program that wrote it");
    };
    if (cicp[1] == pq) refuse("that its codes are PQ, which stand for cd/m2 and not for shares of a display's white");
    if (cicp[1] == hlg) refuse("that its codes are HLG, whose light depends on the display");
    const auto space = video_spaces.find(cicp[0]);
    const std::optional<Curve> curve = video_transfer(cicp[1]);
    if (space == video_spaces.end() || !curve) refuse("a colour space that ssrlab does not know");
    if (cicp[2] != 0 || cicp[3] != 1) refuse("that its codes are not RGB, or do not use the full range");
    if (cicp[0] == 1 && cicp[1] == srgb) return PngColors{};
    const char* const of_curve = cicp[1] == srgb ? "" : cicp[1] == 8 ? " (linear)" : " (a curve that is not sRGB's)";
    return PngColors{*conversion(*curve, space->second.chromaticities),
                     std::string("its colours were converted from ") + space->second.name + of_curve +
                         ", which its chunk cICP names, to sRGB"};
}

/// The profile in iCCP (section 11.3.2.3): a name, 0, a method of compression, 0, and a zlib stream. Empty if there is
/// no such. A profile begins with its size.
std::vector<uint8_t> inflated_profile(Bytes iccp, const EncodedImage& file) {
    constexpr size_t header = 128, longest_name = 79;
    constexpr uint32_t largest = 1 << 24;
    const auto name_end = std::find(iccp.begin(), iccp.begin() + ptrdiff_t(std::min(iccp.size(), longest_name + 1)), 0);
    const size_t begin = size_t(name_end - iccp.begin()) + 2;
    if (begin >= iccp.size()) return {};
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) return {};
    stream.next_in = const_cast<Bytef*>(iccp.data() + begin), stream.avail_in = uInt(iccp.size() - begin);
    std::vector<uint8_t> profile(header);
    const auto fill = [&](size_t from) {
        stream.next_out = profile.data() + from, stream.avail_out = uInt(profile.size() - from);
        const int status = inflate(&stream, Z_SYNC_FLUSH);
        return (status == Z_OK || status == Z_STREAM_END) && stream.avail_out == 0;
    };
    bool is_whole = fill(0);
    const uint32_t size = integer_at(profile, 0);
    is_whole = is_whole && size > header && size <= largest;
    MemoryShare memory;
    if (is_whole) {
        try {
            memory.add(double(size), file.what + ": its ICC profile");
        } catch (...) {
            inflateEnd(&stream);
            throw;
        }
        profile.resize(size);
        is_whole = fill(header);
    }
    inflateEnd(&stream);
    return is_whole ? profile : std::vector<uint8_t>();
}

std::optional<PngColors> of_iccp(Bytes iccp, const EncodedImage& file, std::string& ignored) {
    const std::vector<uint8_t> bytes = inflated_profile(iccp, file);
    std::optional<IccProfile> profile;
    if (!bytes.empty()) profile = read_icc_profile(bytes);
    if (!profile) {
        ignored = "its ICC profile cannot be read and is left aside; ";
        return {};
    }
    if (profile->is_srgb) return PngColors{};
    return PngColors{profile->to_linear,
                     "its colours were converted from its ICC profile '" + shortened(profile->name) + "' to sRGB"};
}

std::optional<double> gamma_of(const std::map<std::string, Bytes>& chunks) {
    const auto found = chunks.find("gAMA");
    if (found == chunks.end() || found->second.size() != 4) return {};
    const double gamma = integer_at(found->second, 0) / 100000.0;
    return gamma > 0.001 && gamma < 1000 ? std::optional(gamma) : std::nullopt;
}

std::optional<Chromaticities> chromaticities_of(const std::map<std::string, Bytes>& chunks) {
    const auto found = chunks.find("cHRM");
    if (found == chunks.end() || found->second.size() != 32) return {};
    const auto at = [&](size_t pair) {
        return glm::dvec2(integer_at(found->second, 8 * pair), integer_at(found->second, 8 * pair + 4)) / 100000.0;
    };
    return Chromaticities{.red = at(1), .green = at(2), .blue = at(3), .white = at(0)};
}

PngColors of_gamma_and_primaries(const std::map<std::string, Bytes>& chunks) {
    constexpr double of_srgb = 0.45455, tolerance = 0.01;
    const std::optional<double> gamma = gamma_of(chunks);
    const std::optional<Chromaticities> primaries = chromaticities_of(chunks);
    const bool is_srgb_curve = !gamma || std::abs(*gamma / of_srgb - 1) <= tolerance,
               is_own_space = !primaries || is_rec709(*primaries);
    if (is_srgb_curve && is_own_space) return {};
    const auto to_linear =
        conversion(is_srgb_curve ? Curve(srgb_curve) : power(1 / *gamma), primaries.value_or(rec709_chromaticities));
    if (!to_linear) return {{}, "its chunk cHRM names no space of colours and is left aside"};
    std::string from;
    if (!is_srgb_curve) from = "gAMA " + shortest_digits(*gamma) + (*gamma == 1 ? " (linear)" : "");
    if (!is_own_space) from += std::string(from.empty() ? "" : " and ") + "the primaries of cHRM";
    return {*to_linear, "its colours were converted from " + from + " to sRGB"};
}

}  // namespace

PngColors png_colors(const EncodedImage& file) {
    const std::map<std::string, Bytes> chunks = chunks_before_pixels(file.bytes);
    std::string ignored;
    if (const auto cicp = chunks.find("cICP"); cicp != chunks.end())
        if (const auto colors = of_cicp(cicp->second, file)) return *colors;
    if (const auto iccp = chunks.find("iCCP"); iccp != chunks.end())
        if (const auto colors = of_iccp(iccp->second, file, ignored)) return *colors;
    PngColors colors = chunks.contains("sRGB") ? PngColors() : of_gamma_and_primaries(chunks);
    if (!ignored.empty()) colors.note = ignored + (colors.note.empty() ? "its codes are taken for sRGB" : colors.note);
    return colors;
}
