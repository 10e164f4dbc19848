#include "experiments/report/report_images.h"

#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/json.h"
#include "core/leftovers.h"
#include "core/path_inside.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/files/verdict_map.h"
#include "metrics/cvvdp/cvvdp.h"
#include "metrics/cvvdp_metric.h"

#include <half.h>
#include <tbb/parallel_for.h>
#include <zlib.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <tuple>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

/// Of frames that are only played: they are wrong by 1.6 % at most, two codes of 255 on a display, and take half the
/// room.
constexpr unsigned played_significand_bits = 5;

/// A map of visible differences, which the report makes of a result and its reference.
constexpr const char* jod_kind = "jod";

/// What the manifest says of one image that is shown.
struct Entry {
    std::string shot, technique, point, kind, target;
    int frame = 0, seed = 0;
    std::string exr;
    std::string reference_exr;  ///< of jod_kind
    float exposure_ev = 0;      ///< of jod_kind
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

/// The maps of visible differences of a study that measures them: one of each result that has a reference. They are of
/// stills, for a sequence of its frame that is kept.
std::vector<Entry> jod_maps(std::span<const Entry> entries, const json& manifest) {
    if (!member(member(manifest, "metrics"), "cvvdp_0_5_6").is_object()) return {};
    std::map<std::string, float> exposures;
    for (const json& shot : member(manifest, "shots"))
        if (const json& ev = member(shot, "exposure_ev"); ev.is_number()) exposures[shot.value("shot", "")] = ev;
    std::map<std::pair<std::string, int>, std::string> references;
    for (const Entry& e : entries)
        if (e.kind == "reference" && e.target == "image") references[{e.shot, e.frame}] = e.exr;
    std::vector<Entry> maps;
    for (const Entry& e : entries) {
        const auto reference = references.find({e.shot, e.frame});
        if (e.kind != "result" || e.target != "image" || reference == references.end()) continue;
        maps.push_back(e);
        maps.back().kind = jod_kind;
        maps.back().reference_exr = reference->second;
        maps.back().exposure_ev = exposures[e.shot];
    }
    return maps;
}

/// What is noticed at each pixel, in JOD that are lost, in all three channels.
HostImage jod_map(const HostImage& reference, const HostImage& result, float exposure_ev) {
    CvvdpStills stills(reference.extent, exposed_viewing({.exposure_ev = exposure_ev}));
    const Plane map = stills.score(reference, result, /*has_map=*/true).map;
    HostImage rgb(reference.extent, 3);
    for (size_t i = 0; i < map.values.size(); ++i)
        for (size_t c = 0; c < 3; ++c) rgb.values[i * 3 + c] = float(map.values[i]);
    return rgb;
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

const char* format_of(const Entry& entry) {
    return entry.kind == "hits"                                    ? "palette"
           : entry.kind == "confidence" || entry.kind == "surface" ? "bytes"
                                                                   : "halves";
}

std::string script_name(const Entry& entry) {
    const std::string ending = entry.kind == jod_kind ? ".jod.js" : ".js";
    return report_image_folder + ("/" + fs::path(entry.exr).replace_extension(ending).string());
}

/// An image as the page has it.
struct Encoded {
    json description;    ///< what its encoding adds: width, height, palette and the like
    size_t clamped = 0;  ///< pixels
    std::string text;    ///< base64; empty if a script has it
};

Encoded encoded(const Entry& entry, const fs::path& exr, const fs::path& reference) {
    HostImage rgb = read_exr_rgb(exr);
    if (entry.kind == jod_kind) rgb = jod_map(read_exr_rgb(reference), rgb, entry.exposure_ev);
    const std::string format = format_of(entry);
    Encoded image{.description = {{"width", rgb.extent.x}, {"height", rgb.extent.y}, {"format", format}}};
    if (format == "palette") {
        image.text = base64(encode_palette(rgb, image.description["palette"]));
    } else if (format == "bytes") {
        image.text = base64(encode_bytes(rgb));
    } else {
        const unsigned bits = entry.kind == "played" ? played_significand_bits : 10;
        if (bits < 10) image.description["significand_bits"] = bits;
        image.text = base64(encode_halves(rgb, image.clamped, bits));
    }
    return image;
}

/// What a script is made of. A script of the same file need not be made again: a report of a large study would spend
/// its time on them.
json origin_of(const Entry& entry, const fs::path& exr, const fs::path& reference) {
    constexpr int version = 1;  // of what encoded() makes
    const auto state_of = [](const fs::path& file) -> json {
        std::error_code error;
        const uintmax_t size = fs::file_size(file, error);
        return {{"size", error ? 0 : size}, {"time", fs::last_write_time(file, error).time_since_epoch().count()}};
    };
    json origin = {{"version", version}, {"kind", entry.kind}};
    origin.update(state_of(exr));
    if (entry.kind == jod_kind) origin.update({{"reference", state_of(reference)}, {"exposure_ev", entry.exposure_ev}});
    return origin;
}

/// The image that an earlier report made of `origin`; none if the script is of another, or is none of ssrlab's.
std::optional<Encoded> kept_image(const fs::path& script, const json& origin) {
    if (fs::symlink_status(script).type() != fs::file_type::regular) return {};
    std::string start(20'000, '\0');  // a palette of 256 colours fits
    std::ifstream in(script, std::ios::binary);
    in.read(start.data(), std::streamsize(start.size()));
    start.resize(size_t(in.gcount()));
    if (!start.starts_with("// ")) return {};
    const json head = json::parse(start.substr(3, start.find('\n') - 3), nullptr, false);
    const auto is_count = [](const json& value) { return value.is_number_unsigned(); };
    if (!head.is_object() || member(head, "origin") != origin || !is_count(member(head, "clamped"))) return {};
    const json& description = member(head, "description");
    if (!description.is_object() || !is_count(member(description, "width")) || !is_count(member(description, "height")))
        return {};
    return Encoded{.description = description, .clamped = head["clamped"], .text = {}};
}

/// Takes images, and keeps them for the page until they are too many for it.
class ImageSink {
public:
    ImageSink(fs::path folder, size_t budget)
        : folder_(std::move(folder)),
          manifest_((folder_ / "manifest.json").string()),
          budget_(budget),
          is_linked_(budget == 0) {}

    void add_all(const json& manifest) {
        const std::vector<Entry> entries = first_seeds(read_entries(folder_, manifest));
        add_all(entries);
        add_all(jod_maps(entries, manifest));  // their images are there, and of one size
    }

    void add_all(std::span<const Entry> entries) {
        constexpr size_t at_once = 64;  // whose texts are in memory beside the page's
        for (; !entries.empty(); entries = entries.subspan(std::min(at_once, entries.size()))) {
            const auto some = entries.first(std::min(at_once, entries.size()));
            std::vector<Encoded> images(some.size());
            tbb::parallel_for(size_t(0), some.size(), [&](size_t i) { images[i] = made(some[i]); });
            for (size_t i = 0; i < some.size(); ++i) add(some[i], images[i]);
        }
    }

    ReportImages finished() {
        if (is_linked_)
            for (size_t i = 0; i < files_.size(); ++i) report_.descriptions[i]["file"] = files_[i];
        for (auto& [entry, image] : in_page_) report_.data.push_back(std::move(image.text));
        return std::move(report_);
    }

    /// The scripts that were written or kept.
    std::set<fs::path> scripts() const {
        std::set<fs::path> all;
        if (is_linked_)
            for (const std::string& file : files_) all.insert(path_inside(folder_, file));
        return all;
    }

private:
    fs::path folder_;
    std::string manifest_;
    size_t budget_, size_ = 0;
    bool is_linked_;
    std::vector<std::string> files_;  ///< of all images so far, whether they are written or not
    std::map<std::string, std::pair<Entry, glm::uvec2>> first_;  ///< image of each shot
    std::vector<std::pair<Entry, Encoded>> in_page_;
    ReportImages report_;

    fs::path inside(const std::string& exr) const { return path_inside(folder_, exr, manifest_ + ": images: 'exr'"); }
    fs::path exr_of(const Entry& entry) const { return inside(entry.exr); }
    fs::path reference_of(const Entry& entry) const {
        return entry.reference_exr.empty() ? fs::path() : inside(entry.reference_exr);
    }

    /// Writes its script, if images are linked.
    Encoded made(const Entry& entry) const {
        const fs::path exr = exr_of(entry), reference = reference_of(entry);
        if (!is_linked_) return encoded(entry, exr, reference);
        if (auto kept = kept_image(path_inside(folder_, script_name(entry)), origin_of(entry, exr, reference)))
            return *kept;
        Encoded image = encoded(entry, exr, reference);
        write(entry, image);
        image.text.clear();
        return image;
    }

    void add(const Entry& entry, Encoded& image) {
        check_extent(entry, {image.description["width"], image.description["height"]});
        json description = {{"shot", entry.shot},   {"frame", entry.frame}, {"technique", entry.technique},
                            {"point", entry.point}, {"kind", entry.kind},   {"target", entry.target},
                            {"seed", entry.seed}};
        description.update(image.description);
        if (image.clamped > 0)
            report_.notes.push_back(
                entry.shot + ", " + entry.technique + " " + entry.point + ": " + std::to_string(image.clamped) +
                " pixels are brighter than 65504, the largest half float. They are shown as 65504.");
        files_.push_back(script_name(entry));
        size_ += image.text.size() + description.dump().size();
        report_.descriptions.push_back(std::move(description));
        if (is_linked_) {
            if (!image.text.empty()) write(entry, image);
            return;
        }
        in_page_.emplace_back(entry, std::move(image));
        if (size_ <= budget_) return;
        is_linked_ = true;
        for (const auto& [of, shown] : in_page_) write(of, shown);
        in_page_.clear();
    }

    void check_extent(const Entry& entry, glm::uvec2 extent) {
        const auto& [other, expected] = first_.emplace(entry.shot, std::pair(entry, extent)).first->second;
        if (extent != expected)
            fail("the images of shot ", entry.shot, " differ in size: ", entry.exr, " is ", extent.x, "x", extent.y,
                 ", ", other.exr, " ", expected.x, "x", expected.y);
    }

    void write(const Entry& entry, const Encoded& image) const {
        const json head = {{"origin", origin_of(entry, exr_of(entry), reference_of(entry))},
                           {"description", image.description},
                           {"clamped", image.clamped}};
        const std::string file = script_name(entry);
        write_text(path_inside(folder_, file),
                   "// " + head.dump() + "\nregisterImage(" + json(file).dump() + ",\"" + image.text + "\");\n");
    }
};

/// Scripts of an earlier report but for `kept`, and parts of such: a page must not find images of other results.
void remove_scripts(const fs::path& folder, const std::set<fs::path>& kept) {
    std::error_code error;
    std::vector<fs::path> scripts;
    for (const auto& file : fs::recursive_directory_iterator(folder, error))
        if ((file.path().extension() == ".js" && file.is_regular_file(error) && !kept.contains(file.path())) ||
            is_leftover(file.path()))
            scripts.push_back(file.path());
    for (const fs::path& script : scripts) {
        fs::remove(script, error);
        for (fs::path parent = script.parent_path(); parent != folder.parent_path(); parent = parent.parent_path())
            fs::remove(parent, error);  // fails where something is left
    }
}

}  // namespace

ReportImages report_images(const fs::path& folder, const json& manifest, size_t budget) {
    const fs::path scripts = path_inside(folder, report_image_folder);
    ImageSink sink(folder, budget);
    sink.add_all(manifest);
    remove_scripts(scripts, sink.scripts());
    return sink.finished();
}

ReportImages embedded_images(const fs::path& folder, const json& manifest) {
    ImageSink sink(folder, SIZE_MAX);
    sink.add_all(manifest);
    return sink.finished();
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
    return compressed(bytes, Redundancy::of_predictions);
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

std::vector<unsigned char> compressed(const std::vector<unsigned char>& bytes, Redundancy redundancy) {
    // Of what is left of predictions runs repeat and nothing else: Z_RLE is four times as fast, and the result smaller.
    const int strategy = redundancy == Redundancy::of_predictions ? Z_RLE : Z_DEFAULT_STRATEGY;
    z_stream stream{};
    constexpr int level = 6, window_bits = 15, memory_level = 8;
    if (deflateInit2(&stream, level, Z_DEFLATED, window_bits, memory_level, strategy) != Z_OK)
        fail_machine("not enough memory to compress a part of a page");
    std::vector<unsigned char> packed(deflateBound(&stream, bytes.size()));
    stream.next_in = const_cast<unsigned char*>(bytes.data()), stream.avail_in = uInt(bytes.size());
    stream.next_out = packed.data(), stream.avail_out = uInt(packed.size());
    const int result = deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    if (result != Z_STREAM_END) fail_machine("a part of a page could not be compressed");
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
