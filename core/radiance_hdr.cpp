#include "core/radiance_hdr.h"

#include "core/chromaticities.h"
#include "core/digits.h"
#include "core/error.h"
#include "core/files.h"
#include "core/near_miss.h"
#include "core/reading_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <span>
#include <string_view>

namespace {

using Texel = std::array<uint8_t, 4>;  ///< three mantissas and their exponent

struct Header {
    bool is_xyz = false;
    glm::dvec3 multiplied{1.0};  ///< by EXPOSURE and COLORCORR
    std::optional<Chromaticities> primaries;
    /// Scan lines go along `fast`, 0: x, 1: y; the other way round where it is negative.
    unsigned fast = 0;
    glm::bvec2 is_reversed{false};
    glm::uvec2 extent{0, 0};
};

class Reader {
public:
    Reader(std::string_view bytes, std::string name) : rest_(bytes), name_(std::move(name)) {}

    Header header() {
        Header header;
        if (!next_line().starts_with("#?")) refuse("it does not begin with #?RADIANCE");
        for (std::string_view line = next_line(); !line.empty(); line = next_line()) read_variable(line, header);
        read_resolution(next_line(), header);
        return header;
    }

    /// Of the old encoding, of the new one, or plain, which each line shows by its first texel.
    void scan_line(std::span<Texel> line) {
        constexpr size_t least_packed = 8, most_packed = 0x7FFF;
        const bool may_be_packed = line.size() >= least_packed && line.size() <= most_packed && rest_.size() >= 4;
        if (may_be_packed && byte(0) == 2 && byte(1) == 2 && size_t(byte(2) << 8 | byte(3)) == line.size())
            read_channels(line);
        else
            read_texels(line);
    }

private:
    [[noreturn]] void refuse(const std::string& why) const {
        fail("cannot read ", name_, " as a Radiance picture: ", why);
    }

    uint8_t byte(size_t at) const { return uint8_t(rest_[at]); }

    std::string_view next_line() {
        const size_t end = rest_.find('\n');
        constexpr size_t longest = 2048;  // Radiance's own limit
        if (end == std::string_view::npos || end > longest) refuse("its header has no end");
        std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }

    /// The numbers after '=', as many as there are places.
    void read_numbers(std::string_view line, std::span<double> numbers) const {
        std::string text(line.substr(line.find('=') + 1));
        const char* at = text.c_str();
        for (double& number : numbers) {
            char* end = nullptr;
            number = std::strtod(at, &end);
            if (end == at || !std::isfinite(number))
                refuse("its header says '" + shortened(std::string(line)) + "', of which " +
                       std::to_string(numbers.size()) + " numbers are needed");
            at = end;
        }
    }

    void read_variable(std::string_view line, Header& header) const {
        const std::string_view name = line.substr(0, line.find('='));
        std::array<double, 8> numbers{};
        if (name == "FORMAT") {
            const bool is_rgb = line.find("32-bit_rle_rgbe") != std::string_view::npos;
            header.is_xyz = line.find("32-bit_rle_xyze") != std::string_view::npos;
            if (!is_rgb && !header.is_xyz)
                refuse("its header says '" + shortened(std::string(line)) +
                       "', but 32-bit_rle_rgbe and 32-bit_rle_xyze are the formats of pictures");
        } else if (name == "EXPOSURE") {
            read_numbers(line, std::span(numbers).first(1));
            header.multiplied *= numbers[0];
        } else if (name == "COLORCORR") {
            read_numbers(line, std::span(numbers).first(3));
            header.multiplied *= glm::dvec3(numbers[0], numbers[1], numbers[2]);
        } else if (name == "PRIMARIES") {
            read_numbers(line, numbers);
            header.primaries = Chromaticities{
                {numbers[0], numbers[1]}, {numbers[2], numbers[3]}, {numbers[4], numbers[5]}, {numbers[6], numbers[7]}};
        } else if (name == "GAMMA") {
            read_numbers(line, std::span(numbers).first(1));
            if (numbers[0] != 1)
                refuse("its header says '" + shortened(std::string(line)) + "'; save it as linear light");
        }
        const double least = std::min({header.multiplied.x, header.multiplied.y, header.multiplied.z});
        const double most = std::max({header.multiplied.x, header.multiplied.y, header.multiplied.z});
        if (!(least > 1e-30 && most < 1e30))
            refuse("its header says '" + shortened(std::string(line)) + "', by which nothing can be divided");
    }

    /// "-Y 512 +X 1024": rows from the top, each from the left. The axis that stands first is that of the scan lines'
    /// order; +Y counts from the bottom.
    void read_resolution(std::string_view line, Header& header) const {
        char sign[2], axis[2], digits[2][10];
        unsigned length[2] = {0, 0};
        const std::string text(line);
        bool is_valid = std::sscanf(text.c_str(), "%c%c %9[0-9] %c%c %9[0-9]", &sign[0], &axis[0], digits[0], &sign[1],
                                    &axis[1], digits[1]) == 6;
        for (int i = 0; is_valid && i < 2; ++i) length[i] = unsigned(std::strtoul(digits[i], nullptr, 10));
        for (int i = 0; is_valid && i < 2; ++i)
            is_valid = (sign[i] == '+' || sign[i] == '-') && (axis[i] == 'X' || axis[i] == 'Y') && length[i] > 0;
        if (!is_valid || axis[0] == axis[1])
            refuse("its resolution is '" + shortened(text) + "', but must be such as '-Y 512 +X 1024'");
        for (int i = 0; i < 2; ++i) {
            const int of = axis[i] == 'X' ? 0 : 1;
            header.extent[of] = length[i];
            header.is_reversed[of] = axis[i] == 'X' ? sign[i] == '-' : sign[i] == '+';
        }
        header.fast = axis[1] == 'X' ? 0 : 1;
    }

    void need(size_t count) const {
        if (rest_.size() < count) refuse("it is cut off");
    }

    /// The new encoding: the four bytes of all texels one after another, each in runs and in bytes as they are.
    void read_channels(std::span<Texel> line) {
        rest_.remove_prefix(4);
        for (size_t channel = 0; channel < 4; ++channel)
            for (size_t x = 0; x < line.size();) {
                need(2);
                const bool is_run = byte(0) > 128;
                const size_t count = is_run ? byte(0) - 128u : byte(0);
                if (count == 0 || count > line.size() - x) refuse("a scan line is longer than its width");
                need(is_run ? 2 : 1 + count);
                for (size_t i = 0; i < count; ++i) line[x + i][channel] = byte(is_run ? 1 : 1 + i);
                x += count, rest_.remove_prefix(is_run ? 2 : 1 + count);
            }
    }

    /// The old encoding: texels, of which those with mantissas of 1 repeat the one before; several in a row are digits
    /// of the count to the base 256, the lowest first.
    void read_texels(std::span<Texel> line) {
        size_t place = 0;
        for (size_t x = 0; x < line.size();) {
            need(4);
            const Texel texel{byte(0), byte(1), byte(2), byte(3)};
            rest_.remove_prefix(4);
            if (texel[0] != 1 || texel[1] != 1 || texel[2] != 1) {
                line[x++] = texel, place = 0;
                continue;
            }
            const size_t count = place < 4 ? size_t(texel[3]) << (8 * place) : 0;
            ++place;
            if (x == 0 || place > 4 || count > line.size() - x) refuse("a scan line is longer than its width");
            for (size_t i = 0; i < count; ++i, ++x) line[x] = line[x - 1];
        }
    }

    std::string_view rest_;
    std::string name_;
};

/// What each exponent makes of 1.
const std::array<float, 256> scale_of_exponent = [] {
    constexpr int bias = 128, mantissa_bits = 8;
    std::array<float, 256> scales{};  // 0: black
    for (int e = 1; e < 256; ++e) scales[size_t(e)] = std::ldexp(1.0f, e - bias - mantissa_bits);
    return scales;
}();

std::string numbers_of(glm::dvec3 v) {
    return v.x == v.y && v.y == v.z ? shortest_digits(v.x)
                                    : shortest_digits(v.x) + " " + shortest_digits(v.y) + " " + shortest_digits(v.z);
}

/// What makes the picture's numbers radiance; nothing where they are.
std::optional<glm::dmat3> conversion(const Header& header, const std::string& name, std::vector<std::string>& notes) {
    std::optional<glm::dmat3> matrix;
    if (header.is_xyz) {
        matrix = glm::inverse(*xyz_from(rec709_chromaticities));
        notes.push_back(name + ": its XYZ was converted to Rec. 709");
    } else if (header.primaries && !is_rec709(*header.primaries)) {
        matrix = rec709_from(*header.primaries);
        if (!matrix) fail("cannot read ", name, " as a Radiance picture: its PRIMARIES span no space of colours");
        notes.push_back(name + ": its colours were converted from its PRIMARIES to Rec. 709");
    }
    if (header.multiplied != glm::dvec3(1.0)) {
        const glm::dvec3 scale = 1.0 / header.multiplied;
        const glm::dmat3 divided(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
        matrix = matrix ? *matrix * divided : divided;
        notes.push_back(name + ": the " + numbers_of(header.multiplied) +
                        " of its EXPOSURE and COLORCORR were divided out, so that its values are radiance");
    }
    return matrix;
}

}  // namespace

HostImage read_radiance_hdr(const std::filesystem::path& file, std::vector<std::string>& notes) {
    const std::string bytes = read_text(file);
    Reader reader(bytes, file.string());
    const Header header = reader.header();
    MemoryShare memory;
    memory.add(double(bytes.size()) + double(header.extent.x) * double(header.extent.y) * sizeof(glm::vec3) +
                   double(header.extent[int(header.fast)]) * sizeof(Texel),
               file.string() + ": its image of " + std::to_string(header.extent.x) + " x " +
                   std::to_string(header.extent.y) + " pixels");
    const std::optional<glm::dmat3> matrix = conversion(header, file.string(), notes);

    HostImage image(header.extent, 3);
    const unsigned fast = header.fast, slow = 1 - fast;
    std::vector<Texel> line(header.extent[int(fast)]);
    for (unsigned i = 0; i < header.extent[int(slow)]; ++i) {
        reader.scan_line(line);
        glm::uvec2 at;
        at[int(slow)] = header.is_reversed[int(slow)] ? header.extent[int(slow)] - 1 - i : i;
        for (unsigned k = 0; k < line.size(); ++k) {
            at[int(fast)] = header.is_reversed[int(fast)] ? unsigned(line.size()) - 1 - k : k;
            const Texel& texel = line[k];
            glm::vec3 color = glm::vec3(texel[0], texel[1], texel[2]) * scale_of_exponent[texel[3]];
            if (matrix) color = glm::vec3(*matrix * glm::dvec3(color));
            image.set_rgb(size_t(at.y) * header.extent.x + at.x, color);
        }
    }
    return image;
}
