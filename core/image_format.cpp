#include "core/image_format.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

using namespace std::string_view_literals;

namespace {

constexpr size_t looked_at = 512;  ///< bytes

/// OpenImageIO's tool takes all formats but those that have a tool of their own below.
constexpr const char* by_oiiotool = "oiiotool {in} -o {png}";

/// A format by what stands at a place of its files. {in} and {png} in a command are the file and what it becomes.
struct KnownFormat {
    size_t at;
    std::string_view mark;
    const char* what;
    const char* command = by_oiiotool;
    bool holds_radiance = false;  ///< as often as display codes
};

constexpr const char* of_avif = "avifdec {in} {png}";
constexpr const char* of_heif = "heif-convert {in} {png}";
constexpr const char* of_jxl = "djxl {in} {png}";

// clang-format off
constexpr KnownFormat formats[] = {
    {0, "II*\0"sv,  "a TIFF", by_oiiotool, true}, {0, "MM\0*"sv, "a TIFF", by_oiiotool, true}, {0, "II+\0"sv, "a BigTIFF", by_oiiotool, true}, {0, "MM\0+"sv, "a BigTIFF", by_oiiotool, true},
    {0, "\xABKTX 20\xBB\r\n\x1A\n"sv, "a KTX 2 texture", "ktx extract --transcode rgba8 {in} {png}"},
    {0, "\xABKTX 11\xBB\r\n\x1A\n"sv, "a KTX texture", "ktx2ktx2 -o {ktx2} {in} && ktx extract {ktx2} {png}"},
    {0, "sB\x13\0"sv, "a Basis Universal texture", "basisu -unpack {in}"},
    {0, "DDS "sv, "a DDS texture", by_oiiotool, true},
    {4, "ftypavif"sv, "an AVIF image", of_avif}, {4, "ftypavis"sv, "an AVIF image", of_avif},
    {4, "ftyphei"sv, "a HEIC image", of_heif}, {4, "ftyphev"sv, "a HEIC image", of_heif},
    {4, "ftypmif1"sv, "a HEIF image", of_heif}, {4, "ftypmsf1"sv, "a HEIF image", of_heif},
    {4, "ftyp"sv, "a video", "ffmpeg -i {in} -frames:v 1 {png}"},
    {0, "\0\0\0\x0CJXL \r\n\x87\n"sv, "a JPEG XL image", of_jxl}, {0, "\xFF\x0A"sv, "a JPEG XL image", of_jxl},
    {0, "\0\0\0\x0CjP  \r\n\x87\n"sv, "a JPEG 2000 image"}, {0, "\xFF\x4F\xFF\x51"sv, "a JPEG 2000 codestream"},
    {0, "8BPS"sv, "a Photoshop file"},
    {0, "GIF8"sv, "a GIF"},
    {0, "BM"sv, "a BMP"},
    {0, "PF\n"sv, "a PFM", by_oiiotool, true}, {0, "Pf\n"sv, "a PFM", by_oiiotool, true},
    {0, "P3"sv, "a PPM"}, {0, "P6"sv, "a PPM"}, {0, "P2"sv, "a PGM"}, {0, "P5"sv, "a PGM"}, {0, "P1"sv, "a PBM"}, {0, "P4"sv, "a PBM"},
    {0, "P7\n"sv, "a PAM", "pamtopng {in} >{png}"},
    {0, "SDPX"sv, "a DPX", by_oiiotool, true}, {0, "XPDS"sv, "a DPX", by_oiiotool, true}, {0, "\x80\x2A\x5F\xD7"sv, "a Cineon file"},
    {0, "\x01\xDA"sv, "an SGI image"},
    {0, "SIMPLE  ="sv, "a FITS file", by_oiiotool, true},
    {0, "qoif"sv, "a QOI image", "qoiconv {in} {png}"},
    {0, "gimp xcf"sv, "a GIMP file", "xcf2png {in} -o {png}"},
    {0, "\x93NUMPY"sv, "a NumPy array", nullptr},
    {0, "glTF"sv, "a binary glTF", nullptr}, {0, "BLENDER"sv, "a Blender file", nullptr},
    {0, "%PDF"sv, "a PDF", "pdftoppm -png -singlefile {in} >{png}"},
    {0, "PK\3\4"sv, "a ZIP archive", "unzip {in}"}, {0, "\x1F\x8B"sv, "compressed by gzip", "gunzip {in}"},
    {0, "\x28\xB5\x2F\xFD"sv, "compressed by zstd", "unzstd {in}"}, {0, "\xFD" "7zXZ\0"sv, "compressed by xz", "unxz {in}"},
    {0, "7z\xBC\xAF\x27\x1C"sv, "a 7-Zip archive", "7z x {in}"},
};
// clang-format on

std::string_view text_of(std::span<const uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), looked_at)};
}

bool has_mark(std::string_view bytes, size_t at, std::string_view mark) {
    return bytes.size() > at && bytes.substr(at).starts_with(mark);
}

/// A file without a mark: a colour map or none, a kind, and no more than 32 bits a pixel (Truevision TGA 2.0).
bool is_tga(std::string_view bytes, const std::string& file) {
    if (bytes.size() < 18 || !std::string_view(file).substr(std::min(file.rfind('.'), file.size())).starts_with(".t"))
        return false;
    const auto byte = [&](size_t at) { return uint8_t(bytes[at]); };
    return byte(1) <= 1 && ((byte(2) >= 1 && byte(2) <= 3) || (byte(2) >= 9 && byte(2) <= 11)) && byte(16) <= 32;
}

/// What servers and version control leave in the place of a file: begins as text in any case of letters.
std::string why_no_image_at_all(std::string_view bytes) {
    if (bytes.empty()) return "is empty";
    std::string start(bytes.substr(0, 200));
    if (start.starts_with("\xEF\xBB\xBF")) start.erase(0, 3);
    start.erase(0, std::min(start.find_first_not_of(" \t\r\n"), start.size()));
    std::ranges::transform(start, start.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if (start.starts_with("<!doctype html") || start.starts_with("<html"))
        return "is an HTML page, which servers send where they have no such file; download it anew";
    if (start.starts_with("version https://git-lfs"))
        return "is a pointer of Git LFS; fetch the file itself: git lfs pull";
    if (start.starts_with("<svg") || (start.starts_with("<?xml") && bytes.find("<svg") != std::string_view::npos))
        return "is an SVG drawing; convert it: rsvg-convert {in} -o {png}";
    if (start.starts_with("<?xml"))
        return "is an XML text; servers send such where they have no file; download it anew";
    if (start.starts_with("{")) return "is a JSON text, not an image";
    return "";
}

/// With names in the places of {in}, the file, and of {png} and the like, what it becomes.
std::string with_names(std::string_view text, const std::string& file) {
    std::string named;
    for (size_t at = 0; at < text.size(); ++at) {
        const size_t end = text[at] == '{' ? text.find('}', at) : std::string_view::npos;
        if (end == std::string_view::npos) {
            named += text[at];
            continue;
        }
        const std::string place(text.substr(at + 1, end - at - 1));
        named += quoted_for_shell(place == "in" ? file : std::filesystem::path(file).replace_extension(place).string());
        at = end;
    }
    return named;
}

std::string command_of(const KnownFormat& format, ImageUse use) {
    if (!format.command) return "";
    const std::string command = format.command;
    if (format.holds_radiance && use != ImageUse::codes)
        return std::string("oiiotool {in} -o {exr}") +
               (use == ImageUse::comparison ? " (if it holds display codes: -o {png})" : "");
    if (use != ImageUse::radiance || !command.ends_with("{png}")) return command;
    if (command == by_oiiotool) return "oiiotool {in} -d float --colorconvert sRGB linear -o {exr}";
    return command + " && oiiotool {png} -d float --colorconvert sRGB linear -o {exr}";
}

/// What the bytes are, with the command after it; empty if they are of no known format.
std::string named_format(std::string_view start, const std::string& file, ImageUse use) {
    static constexpr KnownFormat tga{0, "", "a TGA"};
    const KnownFormat* format =
        std::ranges::find_if(formats, [&](const KnownFormat& one) { return has_mark(start, one.at, one.mark); });
    if (format == std::end(formats)) format = is_tga(start, file) ? &tga : nullptr;
    if (!format) return "";
    const std::string command = command_of(*format, use);
    return std::string("is ") + format->what + (command.empty() ? "" : "; convert it: " + command);
}

/// The name of a format that is read and holds display codes; nullptr of others.
const char* name_of_codes(ImageFormat format) {
    if (format == ImageFormat::png) return "PNG";
    if (format == ImageFormat::jpeg) return "JPEG";
    return format == ImageFormat::webp ? "WebP" : nullptr;
}

}  // namespace

ImageFormat image_format(std::span<const uint8_t> bytes) {
    const std::string_view start = text_of(bytes);
    if (start.starts_with("\x76\x2F\x31\x01"sv)) return ImageFormat::exr;
    if (start.starts_with("\x89PNG\r\n\x1A\n"sv)) return ImageFormat::png;
    if (start.starts_with("\xFF\xD8\xFF"sv)) return ImageFormat::jpeg;
    if (start.starts_with("RIFF"sv) && has_mark(start, 8, "WEBP")) return ImageFormat::webp;
    if (start.starts_with("#?"sv)) return ImageFormat::radiance;
    return ImageFormat::none;
}

std::string why_unreadable(std::span<const uint8_t> bytes, const std::string& file, ImageUse use) {
    const ImageFormat format = image_format(bytes);
    std::string why;
    if (format == ImageFormat::none) {
        why = why_no_image_at_all(text_of(bytes));
        if (why.empty()) why = named_format(text_of(bytes), file, use);
    } else if (const char* const of_codes = name_of_codes(format)) {
        if (use == ImageUse::radiance)
            why = std::string("is a ") + of_codes +
                  ", whose display codes are no radiance; give an OpenEXR or Radiance file, or, if no light is "
                  "brighter than 1, convert it: oiiotool {in} -d float --colorconvert sRGB linear -o {exr}";
        if (use == ImageUse::comparison && format != ImageFormat::png)
            why = std::string("is a ") + of_codes +
                  ", whose losses would count as errors; if they are to count, convert it: oiiotool {in} -o {png}";
    } else if (use == ImageUse::codes) {
        why = std::string("is ") + (format == ImageFormat::exr ? "an OpenEXR" : "a Radiance") +
              " image; convert it: oiiotool {in} --colorconvert linear sRGB -d uint16 -o {png}";
    }
    return with_names(why, file);
}

std::vector<uint8_t> first_bytes(const std::filesystem::path& file) {
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) fail_machine("cannot open ", file.string(), ": ", errno ? std::strerror(errno) : "unknown reason");
    std::vector<uint8_t> bytes(looked_at);
    in.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()));
    bytes.resize(size_t(std::max<std::streamsize>(in.gcount(), 0)));
    return bytes;
}

std::string quoted_for_shell(const std::string& name) {
    if (name.starts_with('-')) return quoted_for_shell("./" + name);  // no option
    const bool is_plain = !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
        return std::isalnum(c) || std::string_view("_./-+,:@%").find(char(c)) != std::string_view::npos;
    });
    if (is_plain) return name;
    std::string quoted = "'";
    for (const char c : name) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}
