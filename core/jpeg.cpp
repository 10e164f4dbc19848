#include "core/jpeg.h"

#include "core/error.h"
#include "core/image_format.h"

#include <csetjmp>
#include <cstdio>
#include <filesystem>
// libjpeg's header needs the two before it.
#include <jerror.h>
#include <jpeglib.h>

namespace {

/// All that the functions below change: libjpeg reports errors to a function that may not return, and longjmp() leaves
/// no other object of a function whole.
struct JpegDecoder {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    jmp_buf on_error;
    char error[JMSG_LENGTH_MAX] = "", warning[JMSG_LENGTH_MAX] = "";  ///< warning: the first
    bool has_no_end = false;  ///< the bytes end before the marker that ends a JPEG

    ~JpegDecoder() { jpeg_destroy_decompress(&jpeg); }
};

JpegDecoder& decoder_of(j_common_ptr jpeg) { return *static_cast<JpegDecoder*>(jpeg->client_data); }

[[noreturn]] void stop(j_common_ptr jpeg) {
    JpegDecoder& d = decoder_of(jpeg);
    jpeg->err->format_message(jpeg, d.error);
    longjmp(d.on_error, 1);
}

/// `level`: -1 of warnings, else of traces.
void take_message(j_common_ptr jpeg, int level) {
    if (level >= 0) return;
    JpegDecoder& d = decoder_of(jpeg);
    switch (jpeg->err->msg_code) {
        case JWRN_JPEG_EOF:
            d.has_no_end = true;
            return;
        case JWRN_EXTRANEOUS_DATA:
        case JWRN_ADOBE_XFORM:
        case JWRN_BOGUS_PROGRESSION:
        case JWRN_NOT_SEQUENTIAL:
            if (!d.warning[0]) jpeg->err->format_message(jpeg, d.warning);
            return;
        default:  // what follows in the picture is not what was encoded
            stop(jpeg);
    }
}

/// Without a limit on the scans, a few kilobytes of them decode the whole image as many times.
void count_scans(j_common_ptr jpeg) {
    constexpr int most_scans = 500;
    if (!jpeg->is_decompressor || reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= most_scans) return;
    std::snprintf(decoder_of(jpeg).error, JMSG_LENGTH_MAX, "it has more than %d scans", most_scans);
    longjmp(decoder_of(jpeg).on_error, 1);
}

bool read_header(JpegDecoder& d, std::span<const uint8_t> bytes) {
    d.jpeg.err = jpeg_std_error(&d.errors);
    d.jpeg.client_data = &d;
    d.errors.error_exit = stop;
    d.errors.emit_message = take_message;
    if (setjmp(d.on_error)) return false;
    jpeg_create_decompress(&d.jpeg);
    d.progress.progress_monitor = count_scans;
    d.jpeg.progress = &d.progress;
    jpeg_mem_src(&d.jpeg, bytes.data(), static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&d.jpeg, TRUE);
    return true;
}

/// Whether each coefficient of a progressive JPEG came with all its bits.
bool has_all_bits(const jpeg_decompress_struct& jpeg) {
    for (int c = 0; c < jpeg.num_components; ++c)
        for (int k = 0; k < DCTSIZE2; ++k)
            if (jpeg.coef_bits[c][k] != 0) return false;
    return true;
}

/// A file without an end may lack scans, too: of a progressive one the bits say so, of others several scans are not
/// trusted.
bool read_rows(JpegDecoder& d, uint8_t* rgba) {
    if (setjmp(d.on_error)) return false;
    d.jpeg.out_color_space = JCS_EXT_RGBA;
    d.jpeg.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&d.jpeg);
    const size_t row = size_t(d.jpeg.output_width) * 4;
    while (d.jpeg.output_scanline < d.jpeg.output_height) {
        JSAMPROW to = rgba + d.jpeg.output_scanline * row;
        jpeg_read_scanlines(&d.jpeg, &to, 1);
    }
    const bool has_all_scans = d.jpeg.progressive_mode ? has_all_bits(d.jpeg) : !jpeg_has_multiple_scans(&d.jpeg);
    jpeg_finish_decompress(&d.jpeg);
    if (!d.has_no_end || has_all_scans) return true;
    std::snprintf(d.error, sizeof d.error, "it is cut off");
    return false;
}

/// What an intact JPEG is that libjpeg cannot decode, with the command that converts it; "" of others.
std::string unknown_kind(const JpegDecoder& d, const std::string& file) {
    const std::string in = quoted_for_shell(file),
                      out = quoted_for_shell(std::filesystem::path(file).replace_extension(".png").string());
    const std::string by_newer = "; convert it: djpeg " + in + " | pnmtopng >" + out + " (djpeg of libjpeg-turbo 3)";
    const int parameter = d.errors.msg_parm.i[0];
    if (d.errors.msg_code == JERR_BAD_PRECISION)
        return "it is a JPEG of " + std::to_string(parameter) + " bits, of which 8 are read" + by_newer;
    if (d.errors.msg_code != JERR_SOF_UNSUPPORTED) return "";
    constexpr int lossless = 0xC3, lossless_arithmetic = 0xCB;
    if (parameter == lossless || parameter == lossless_arithmetic) return "it is a lossless JPEG" + by_newer;
    return "it is a hierarchical JPEG, which hardly any program reads; save it as PNG with the one that wrote it";
}

}  // namespace

DecodedImage decode_jpeg(const EncodedImage& image, unsigned longest_side) {
    JpegDecoder d;
    const auto refuse = [&] {
        const std::string kind = unknown_kind(d, image.file);
        fail(image.what,
             " cannot be decoded: ", kind.empty() ? "as a JPEG it is broken: " + std::string(d.error) : kind);
    };
    if (!read_header(d, image.bytes)) refuse();
    const J_COLOR_SPACE space = d.jpeg.jpeg_color_space;
    if (space != JCS_GRAYSCALE && space != JCS_YCbCr && space != JCS_RGB)
        fail(image.what, " cannot be decoded: it is a JPEG of ", d.jpeg.num_components, " components",
             space == JCS_CMYK   ? " (CMYK)"
             : space == JCS_YCCK ? " (CMYK as YCCK)"
                                 : "",
             ", of which no RGB can be made without a profile; convert it: convert ", quoted_for_shell(image.file),
             " -colorspace sRGB ",
             quoted_for_shell(std::filesystem::path(image.file).replace_extension(".png").string()));
    DecodedImage decoded;
    decoded.extent = {d.jpeg.image_width, d.jpeg.image_height};
    decoded.stored = std::string("8 bits, ") +
                     (space == JCS_GRAYSCALE ? "grey"
                      : space == JCS_RGB     ? "RGB"
                                             : "YCbCr") +
                     (d.jpeg.progressive_mode ? ", progressive" : "");
    constexpr double of_decoder = 10;  // planes, coefficients, and rows as they are upsampled
    const MemoryShare more = reserve_memory(image, decoded, longest_side, of_decoder);
    decoded.rgba.resize(size_t(decoded.extent.x) * decoded.extent.y * 4);
    if (!read_rows(d, decoded.rgba.data())) refuse();
    if (d.warning[0]) decoded.warnings.push_back(std::string("it is not a valid JPEG: ") + d.warning);
    if (d.has_no_end) decoded.warnings.push_back("it is not a valid JPEG: its end is missing, behind all of its data");
    return decoded;
}
