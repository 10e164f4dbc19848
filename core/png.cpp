#include "core/png.h"

#include "core/error.h"
#include "core/files.h"
#include "core/image_format.h"
#include "core/png_colors.h"
#include "core/reading_limits.h"

#include <png.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <limits>

namespace {

/// All that the functions below change: libpng reports errors by longjmp(), which leaves no other object of a function
/// whole.
struct PngDecoder {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::span<const uint8_t> rest;
    char error[200] = "", warning[200] = "";  ///< warning: the first

    ~PngDecoder() { png_destroy_read_struct(&png, &info, nullptr); }
};

PngDecoder& decoder_of(png_structp png) { return *static_cast<PngDecoder*>(png_get_error_ptr(png)); }

void hand_out(png_structp png, png_bytep to, size_t count) {
    auto& rest = decoder_of(png).rest;
    if (rest.size() < count) png_error(png, "it is cut off");
    std::memcpy(to, rest.data(), count);
    rest = rest.subspan(count);
}

void start(PngDecoder& d) {
    d.png = png_create_read_struct(
        PNG_LIBPNG_VER_STRING, &d,
        [](png_structp png, png_const_charp why) {
            std::snprintf(decoder_of(png).error, sizeof d.error, "%s", why);
            png_longjmp(png, 1);
        },
        [](png_structp png, png_const_charp what) {
            PngDecoder& warned = decoder_of(png);
            if (!warned.warning[0]) std::snprintf(warned.warning, sizeof d.warning, "%s", what);
        });
    d.info = png_create_info_struct(d.png);
}

/// Chunks beside those of the pixels and their alpha are only looked at for their checksums, of which each must be
/// right. That of the zlib stream covers the same bytes again.
bool read_header(PngDecoder& d) {
    if (setjmp(png_jmpbuf(d.png))) return false;
    png_set_read_fn(d.png, nullptr, hand_out);
    png_set_crc_action(d.png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_set_keep_unknown_chunks(d.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_option(d.png, PNG_IGNORE_ADLER32, PNG_OPTION_ON);
    constexpr png_uint_32 longest = 0x7FFFFFFF;  // the format's; what that may cost is asked elsewhere
    png_set_user_limits(d.png, longest, longest);
    png_read_info(d.png, d.info);
    return true;
}

/// Colours are expanded, and not converted. `row`: bytes of one in `codes`.
bool read_rows(PngDecoder& d, uint8_t* codes, size_t row) {
    if (setjmp(png_jmpbuf(d.png))) return false;
    png_set_expand(d.png);
    png_set_gray_to_rgb(d.png);
    png_set_add_alpha(d.png, 0xFFFF, PNG_FILLER_AFTER);
    if (std::endian::native == std::endian::little) png_set_swap(d.png);
    const int passes = png_set_interlace_handling(d.png);
    png_read_update_info(d.png, d.info);
    if (png_get_rowbytes(d.png, d.info) != row) png_error(d.png, "its rows have another length than its header says");
    const unsigned height = png_get_image_height(d.png, d.info);
    for (int pass = 0; pass < passes; ++pass)
        for (unsigned y = 0; y < height; ++y) png_read_row(d.png, codes + y * row, nullptr);
    png_read_end(d.png, nullptr);
    return true;
}

std::string stored_as(const PngDecoder& d) {
    const auto colors = [&] {
        switch (png_get_color_type(d.png, d.info)) {
            case PNG_COLOR_TYPE_GRAY:
                return "grey";
            case PNG_COLOR_TYPE_GRAY_ALPHA:
                return "grey with alpha";
            case PNG_COLOR_TYPE_PALETTE:
                return "a palette";
            case PNG_COLOR_TYPE_RGB_ALPHA:
                return "RGB with alpha";
            default:
                return "RGB";
        }
    };
    return std::to_string(png_get_bit_depth(d.png, d.info)) + " bits, " + colors() +
           (png_get_valid(d.png, d.info, PNG_INFO_tRNS) ? " with transparent colours" : "") +
           (png_get_interlace_type(d.png, d.info) == PNG_INTERLACE_NONE ? "" : ", interlaced");
}

/// Three codes of each texel, and whether each alpha is the greatest.
template <class Code>
bool take_rgb(const DecodedImage& from, HostImage& rgb) {
    constexpr Code most = std::numeric_limits<Code>::max();
    std::vector<float> value_of(size_t(most) + 1);
    for (size_t code = 0; code < value_of.size(); ++code) value_of[code] = float(code) / float(most);
    bool is_opaque = true;
    for (size_t i = 0; i < rgb.pixel_count(); ++i) {
        Code code[4];
        std::memcpy(code, &from.rgba[i * sizeof code], sizeof code);
        for (unsigned c = 0; c < 3; ++c) rgb.values[i * 3 + c] = value_of[code[c]];
        is_opaque &= code[3] == most;
    }
    return is_opaque;
}

void convert(HostImage& codes, const PngColors& colors) {
    std::vector<glm::vec3> row(codes.extent.x);
    for (unsigned y = 0; y < codes.extent.y; ++y) {
        float* const values = codes.pixel(0, y);
        std::memcpy(row.data(), values, row.size() * sizeof(glm::vec3));
        colors.to_linear(row);
        for (unsigned x = 0; x < codes.extent.x; ++x)
            for (int c = 0; c < 3; ++c) values[3 * x + unsigned(c)] = srgb_from_linear(row[x][c]);
    }
}

}  // namespace

float srgb_from_linear(float linear) {
    if (linear < 0.0f) return -srgb_from_linear(-linear);
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

template <class Real>
static Real decoded_srgb(Real code) {
    if (code < 0) return -decoded_srgb(-code);
    return code <= Real(0.04045) ? code / Real(12.92) : std::pow((code + Real(0.055)) / Real(1.055), Real(2.4));
}

float linear_from_srgb(float code) { return decoded_srgb(code); }
double linear_from_srgb(double code) { return decoded_srgb(code); }

void write_png(const std::filesystem::path& file, const HostImage& rgb, float exposure_ev) {
    if (rgb.pixel_count() == 0) fail("cannot write ", file.string(), ": the image has zero size");
    const float scale = std::exp2(exposure_ev);
    std::vector<unsigned char> bytes(rgb.pixel_count() * 3);
    for (size_t i = 0; i < rgb.pixel_count(); ++i) {
        const glm::vec3 c = rgb.rgb(i) * scale;
        const bool is_nan = std::isnan(c.x) || std::isnan(c.y) || std::isnan(c.z);
        for (int k = 0; k < 3; ++k) {
            const float code = is_nan ? float(k != 1) : srgb_from_linear(std::clamp(c[k], 0.0f, 1.0f));
            bytes[i * 3 + k] = static_cast<unsigned char>(std::lround(code * 255.0f));
        }
    }
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = rgb.extent.x;
    png.height = rgb.extent.y;
    png.format = PNG_FORMAT_RGB;
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        if (!png_image_write_to_file(&png, temporary.c_str(), 0, bytes.data(), 0, nullptr))
            fail_write(file, png.message);
    });
}

namespace {

/// All that encode() changes: libpng reports errors by longjmp(), which leaves no other object of a function whole.
struct PngEncoder {
    png_structp png = nullptr;
    png_infop info = nullptr;
    char error[200] = "";
    std::vector<std::byte> file;

    ~PngEncoder() { png_destroy_write_struct(&png, &info); }
};

bool encode(PngEncoder& e, glm::uvec2 extent, unsigned channels, unsigned channel_bytes, const uint8_t* codes) {
    if (setjmp(png_jmpbuf(e.png))) return false;
    png_set_write_fn(
        e.png, &e.file,
        [](png_structp png, png_bytep bytes, size_t count) {
            auto& file = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
            const auto* const begin = reinterpret_cast<const std::byte*>(bytes);
            file.insert(file.end(), begin, begin + count);
        },
        [](png_structp) {});
    png_set_IHDR(e.png, e.info, extent.x, extent.y, int(8 * channel_bytes),
                 channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(e.png, e.info, PNG_sRGB_INTENT_PERCEPTUAL);  // what programs that heed colour spaces leave as it is
    png_write_info(e.png, e.info);
    if (channel_bytes == 2 && std::endian::native == std::endian::little) png_set_swap(e.png);
    for (unsigned y = 0; y < extent.y; ++y)
        png_write_row(e.png, codes + size_t(y) * extent.x * channels * channel_bytes);
    png_write_end(e.png, e.info);
    return true;
}

}  // namespace

std::vector<std::byte> encode_png(glm::uvec2 extent, unsigned channels, unsigned channel_bytes,
                                  std::span<const uint8_t> codes) {
    PngEncoder encoder;
    encoder.png = png_create_write_struct(
        PNG_LIBPNG_VER_STRING, encoder.error,
        [](png_structp png, png_const_charp why) {
            std::snprintf(static_cast<char*>(png_get_error_ptr(png)), sizeof encoder.error, "%s", why);
            png_longjmp(png, 1);
        },
        [](png_structp, png_const_charp) {});
    encoder.info = png_create_info_struct(encoder.png);
    if (!encode(encoder, extent, channels, channel_bytes, codes.data()))
        fail_machine("an image of ", extent.x, " x ", extent.y, " texels cannot be written as PNG: ", encoder.error);
    return std::move(encoder.file);
}

DecodedImage decode_png(const EncodedImage& image, unsigned longest_side) {
    PngDecoder decoder;
    decoder.rest = image.bytes;
    start(decoder);
    const auto refuse = [&] { fail(image.what, " cannot be decoded: as a PNG it is broken: ", decoder.error); };
    if (!read_header(decoder)) refuse();
    DecodedImage decoded;
    decoded.extent = {png_get_image_width(decoder.png, decoder.info), png_get_image_height(decoder.png, decoder.info)};
    decoded.channel_bytes = png_get_bit_depth(decoder.png, decoder.info) == 16 ? 2 : 1;
    decoded.stored = stored_as(decoder);     // before libpng is asked to expand it
    constexpr double bytes_of_rows = 2 * 8;  // one is expanded in place, beside the one before it
    const MemoryShare of_decoder =
        reserve_memory(image, decoded, longest_side, bytes_of_rows / std::max(decoded.extent.y, 1u));
    const size_t row = decoded.extent.x * decoded.texel_bytes();
    decoded.rgba.resize(row * decoded.extent.y);
    if (!read_rows(decoder, decoded.rgba.data(), row)) refuse();
    if (decoder.warning[0]) decoded.warnings.push_back(std::string("it is not a valid PNG: ") + decoder.warning);
    return decoded;
}

HostImage read_png_codes(const std::filesystem::path& file, std::vector<std::string>& notes) {
    const std::string bytes = read_text(file), name = file.string();
    const EncodedImage encoded{{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, name, name};
    if (image_format(encoded.bytes) != ImageFormat::png) {
        const std::string why = why_unreadable(encoded.bytes, name, ImageUse::codes);
        fail("cannot read ", name, " as PNG: it ", why.empty() ? "does not begin as one" : why);
    }
    MemoryShare memory;
    memory.add(double(bytes.size()), name);
    const PngColors colors = png_colors(encoded);
    const DecodedImage decoded = decode_png(encoded, std::numeric_limits<unsigned>::max());
    memory.add(double(decoded.extent.x) * double(decoded.extent.y) * sizeof(glm::vec3),
               name + ": the image of its colours");
    HostImage rgb(decoded.extent, 3);
    const bool is_opaque =
        decoded.channel_bytes == 2 ? take_rgb<uint16_t>(decoded, rgb) : take_rgb<uint8_t>(decoded, rgb);
    if (colors.to_linear) convert(rgb, colors);
    for (const std::string& warning : decoded.warnings) notes.push_back(name + ": " + warning);
    if (!colors.note.empty()) notes.push_back(name + ": " + colors.note);
    if (!is_opaque)
        notes.push_back(name +
                        ": it has an alpha channel that is not opaque; its colours are taken as they are stored, "
                        "not over anything");
    return rgb;
}

HostImage read_png_codes(const std::filesystem::path& file) {
    std::vector<std::string> notes;
    return read_png_codes(file, notes);
}
