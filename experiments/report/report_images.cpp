#include "experiments/report/report_images.h"

#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/json.h"
#include "core/leftovers.h"
#include "core/path_inside.h"
#include "experiments/results/files/verdict_map.h"

#include <half.h>
#include <zlib.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

/// Of frames that are only played: they are wrong by 1.6 % at most, two codes of 255 on a display, and take half the
/// room.
constexpr unsigned played_significand_bits = 5;

/// What the manifest says of one image that is shown.
struct Entry {
    std::string shot, technique, point, kind, target;
    int frame = 0, seed = 0;
    std::string exr;
};

bool is_shown(const std::string& kind) {
    for (const char* shown : {"result", "reference", "played", "confidence", "hits", "surface"})
        if (kind == shown) return true;
    return false;
}

std::vector<Entry> read_entries(const fs::path& folder, const json& manifest) {
    std::vector<Entry> entries;
    JsonObject all(manifest, (folder / "manifest.json").string());
    for (JsonObject& image : all.objects("images")) {
        Entry e{.shot = image.text("shot"),
                .technique = image.text("technique"),
                .point = image.text("point", ""),
                .kind = image.text("kind"),
                .target = image.text("target", ""),
                .frame = image.integer("frame", 0, INT32_MAX, 0),
                .seed = image.integer("seed", 0, INT32_MAX, 0),
                .exr = {}};
        if (!is_shown(e.kind)) continue;
        e.exr = image.text("exr");
        entries.push_back(std::move(e));
    }
    return entries;
}

/// Of each technique point's images only those of its first seed, which is how a reader meets it.
std::vector<Entry> first_seeds(std::vector<Entry> entries) {
    const auto key = [](const Entry& e) { return std::tuple(e.shot, e.frame, e.technique, e.point, e.kind, e.target); };
    std::map<decltype(key(entries[0])), int> first;
    for (const Entry& e : entries) {
        const auto at = first.emplace(key(e), e.seed).first;
        at->second = std::min(at->second, e.seed);
    }
    std::erase_if(entries, [&](const Entry& e) { return e.seed != first[key(e)]; });
    return entries;
}

/// Of a plane with `width` values per row: from the values to the left, above, and above the left.
int predicted(const std::vector<int16_t>& plane, size_t width, size_t i) {
    const bool has_left = i % width != 0, has_above = i >= width;
    if (!has_left || !has_above) return has_left ? plane[i - 1] : has_above ? plane[i - width] : 0;
    const int left = plane[i - 1], above = plane[i - width], corner = plane[i - width - 1];
    const auto [low, high] = std::minmax(left, above);
    return corner >= high ? low : corner <= low ? high : left + above - corner;
}

/// Integers in the order of the half floats that the bits stand for; no two are equal.
int16_t ordered(uint16_t bits) { return int16_t(bits < 0x8000 ? bits : 0x7fff - bits); }

/// Takes images, and keeps them for the page until they are too many for it.
class ImageSink {
public:
    ImageSink(fs::path folder, size_t budget)
        : folder_(std::move(folder)), manifest_((folder_ / "manifest.json").string()), budget_(budget) {}

    void add(const Entry& entry, ReportImages& report) {
        const HostImage rgb = read_exr_rgb(path_inside(folder_, entry.exr, manifest_ + ": images: 'exr'"));
        check_extent(entry, rgb.extent);
        json description = {{"shot", entry.shot},        {"frame", entry.frame},  {"technique", entry.technique},
                            {"point", entry.point},      {"kind", entry.kind},    {"target", entry.target},
                            {"seed", entry.seed},        {"width", rgb.extent.x}, {"height", rgb.extent.y},
                            {"format", format_of(entry)}};
        const std::string text = base64(encoded(entry, rgb, description, report.notes));
        files_.push_back(script_name(entry));
        size_ += text.size() + description.dump().size();
        report.descriptions.push_back(std::move(description));
        if (is_linked_) return write(files_.back(), text);
        report.data.push_back(text);
        if (size_ <= budget_) return;
        is_linked_ = true;
        for (size_t i = 0; i < report.data.size(); ++i) write(files_[i], report.data[i]);
        report.data.clear();
    }

    void finish(ReportImages& report) const {
        if (!is_linked_) return;
        for (size_t i = 0; i < files_.size(); ++i) report.descriptions[i]["file"] = files_[i];
    }

private:
    fs::path folder_;
    std::string manifest_;
    size_t budget_, size_ = 0;
    bool is_linked_ = false;
    std::vector<std::string> files_;  ///< of all images so far, whether they are written or not
    std::map<std::string, std::pair<Entry, glm::uvec2>> first_;  ///< image of each shot

    static const char* format_of(const Entry& entry) {
        return entry.kind == "hits"                                    ? "palette"
               : entry.kind == "confidence" || entry.kind == "surface" ? "bytes"
                                                                       : "halves";
    }

    static std::string script_name(const Entry& entry) {
        return report_image_folder + ("/" + fs::path(entry.exr).replace_extension(".js").string());
    }

    static std::vector<unsigned char> encoded(const Entry& entry, const HostImage& rgb, json& description,
                                              std::vector<std::string>& notes) {
        const std::string format = format_of(entry);
        if (format == "palette") return encode_palette(rgb, description["palette"]);
        if (format == "bytes") return encode_bytes(rgb);
        size_t clamped = 0;
        const unsigned bits = entry.kind == "played" ? played_significand_bits : 10;
        if (bits < 10) description["significand_bits"] = bits;
        std::vector<unsigned char> bytes = encode_halves(rgb, clamped, bits);
        if (clamped > 0)
            notes.push_back(entry.shot + ", " + entry.technique + " " + entry.point + ": " + std::to_string(clamped) +
                            " pixels are brighter than 65504, the largest half float. They are shown as 65504.");
        return bytes;
    }

    void check_extent(const Entry& entry, glm::uvec2 extent) {
        const auto& [other, expected] = first_.emplace(entry.shot, std::pair(entry, extent)).first->second;
        if (extent != expected)
            fail("the images of shot ", entry.shot, " differ in size: ", entry.exr, " is ", extent.x, "x", extent.y,
                 ", ", other.exr, " ", expected.x, "x", expected.y);
    }

    void write(const std::string& file, const std::string& text) const {
        write_text(path_inside(folder_, file), "registerImage(" + json(file).dump() + ",\"" + text + "\");\n");
    }
};

/// Scripts of an earlier report, and parts of such: a page must not find images of other results.
void remove_scripts(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> scripts;
    for (const auto& file : fs::recursive_directory_iterator(folder, error))
        if ((file.path().extension() == ".js" && file.is_regular_file(error)) || is_leftover(file.path()))
            scripts.push_back(file.path());
    for (const fs::path& script : scripts) {
        fs::remove(script, error);
        for (fs::path parent = script.parent_path(); parent != folder.parent_path(); parent = parent.parent_path())
            fs::remove(parent, error);  // fails where something is left
    }
}

}  // namespace

ReportImages report_images(const fs::path& folder, const json& manifest, size_t budget) {
    remove_scripts(path_inside(folder, report_image_folder));
    ReportImages report;
    ImageSink sink(folder, budget);
    for (const Entry& entry : first_seeds(read_entries(folder, manifest))) sink.add(entry, report);
    sink.finish(report);
    return report;
}

ReportImages embedded_images(const fs::path& folder, const json& manifest) {
    ReportImages report;
    ImageSink sink(folder, SIZE_MAX);
    for (const Entry& entry : first_seeds(read_entries(folder, manifest))) sink.add(entry, report);
    return report;
}

std::vector<unsigned char> encode_halves(const HostImage& rgb, size_t& clamped, unsigned significand_bits) {
    const size_t pixels = rgb.pixel_count(), count = pixels * 3;
    std::array<std::vector<int16_t>, 3> planes;
    for (std::vector<int16_t>& plane : planes) plane.resize(pixels);
    clamped = 0;
    for (size_t i = 0; i < pixels; ++i) {
        bool is_beyond = false;
        std::array<int16_t, 3> channels;
        for (size_t c = 0; c < 3; ++c) {
            float value = rgb.values[i * 3 + c];
            if (std::isfinite(value) && std::abs(value) > 65504.0f) {
                is_beyond = true;
                value = std::copysign(65504.0f, value);
            }
            channels[c] = int16_t(ordered(half(value).round(significand_bits).bits()) >> (10 - significand_bits));
        }
        planes[0][i] = channels[1];
        planes[1][i] = int16_t(channels[0] - channels[1]), planes[2][i] = int16_t(channels[2] - channels[1]);
        clamped += is_beyond;
    }
    std::vector<unsigned char> bytes(2 * count);
    for (size_t p = 0; p < 3; ++p)
        for (size_t i = 0; i < pixels; ++i) {
            const int16_t left = int16_t(planes[p][i] - predicted(planes[p], rgb.extent.x, i));
            const uint16_t code = uint16_t(left << 1 ^ left >> 15);
            bytes[p * pixels + i] = code & 255;
            bytes[count + p * pixels + i] = code >> 8;
        }
    return compressed(bytes);
}

std::vector<unsigned char> encode_bytes(const HostImage& image) {
    std::vector<unsigned char> bytes(image.pixel_count());
    for (size_t i = 0; i < bytes.size(); ++i) {
        const float value = image.values[i * image.channels];
        bytes[i] =
            std::isfinite(value) ? static_cast<unsigned char>(std::lround(254 * std::clamp(value, 0.0f, 1.0f))) : 255;
    }
    return compressed(bytes);
}

std::vector<unsigned char> encode_palette(const HostImage& rgb, json& palette) {
    std::map<std::array<int, 3>, size_t> places;
    palette = json::array();
    std::vector<unsigned char> bytes(rgb.pixel_count());
    for (size_t i = 0; i < bytes.size(); ++i) {
        std::array<int, 3> color;
        for (size_t c = 0; c < 3; ++c)
            color[c] =
                int(std::lround(255 * std::pow(std::clamp(rgb.values[i * 3 + c], 0.0f, 1.0f), 1 / verdict_map_gamma)));
        const auto [place, is_new] = places.emplace(color, places.size());
        if (is_new) palette.push_back(color);
        if (places.size() > 256) fail("a map of verdicts has more than 256 colours");
        bytes[i] = static_cast<unsigned char>(place->second);
    }
    return compressed(bytes);
}

std::vector<unsigned char> compressed(const std::vector<unsigned char>& bytes) {
    uLongf size = compressBound(bytes.size());
    std::vector<unsigned char> packed(size);
    if (compress2(packed.data(), &size, bytes.data(), bytes.size(), 6) != Z_OK)
        fail_machine("not enough memory to compress a part of a page");
    packed.resize(size);
    return packed;
}

std::string base64(const std::vector<unsigned char>& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const auto at = [&](size_t k) { return i + k < bytes.size() ? unsigned(bytes[i + k]) : 0u; };
        const unsigned group = at(0) << 16 | at(1) << 8 | at(2);
        for (int shift = 18; shift >= 0; shift -= 6) text += digits[group >> shift & 63];
    }
    for (size_t pad = 0; pad < (3 - bytes.size() % 3) % 3; ++pad) text[text.size() - 1 - pad] = '=';
    return text;
}
