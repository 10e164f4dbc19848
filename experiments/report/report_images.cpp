#include "experiments/report/report_images.h"

#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/json.h"
#include "core/leftovers.h"
#include "core/path_inside.h"
#include "experiments/report/image_encoding.h"
#include "experiments/results/files/manifest.h"
#include "metrics/cvvdp/cvvdp.h"
#include "metrics/cvvdp_metric.h"

#include <tbb/parallel_for.h>
#include <algorithm>
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
