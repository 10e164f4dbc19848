#include "experiments/report/report_images.h"

#include "core/error.h"
#include "core/exr.h"
#include "core/json.h"

#include <half.h>
#include <zlib.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace {

/// What the manifest says of one image that may be shown.
struct Entry {
    std::string shot, variant, point, kind, target;
    int seed = 0;
    std::filesystem::path exr;
};

std::vector<Entry> read_entries(const std::filesystem::path& folder, const nlohmann::json& manifest) {
    std::vector<Entry> entries;
    JsonObject all(manifest, (folder / "manifest.json").string());
    for (JsonObject& image : all.objects("images")) {
        Entry e{.shot = image.text("shot"),
                .variant = image.text("variant"),
                .point = image.text("point", ""),
                .kind = image.text("kind"),
                .target = image.text("target", ""),
                .seed = image.integer("seed", 0, INT32_MAX, 0),
                .exr = {}};
        if (e.kind != "result" && e.kind != "reference") continue;
        e.exr = folder / image.text("exr");
        entries.push_back(std::move(e));
    }
    return entries;
}

/// Of each variant point's results only those of its first seed, which is how a reader meets it.
std::vector<Entry> first_seeds(std::vector<Entry> entries) {
    const auto key = [](const Entry& e) { return std::tuple(e.shot, e.variant, e.point, e.target); };
    std::map<decltype(key(entries[0])), int> first;
    for (const Entry& e : entries) {
        const auto at = first.emplace(key(e), e.seed).first;
        at->second = std::min(at->second, e.seed);
    }
    std::erase_if(entries, [&](const Entry& e) { return e.seed != first[key(e)]; });
    return entries;
}

HostImage reduced(const HostImage& rgb, unsigned factor) {
    if (factor == 1) return rgb;
    HostImage small({(rgb.extent.x + factor - 1) / factor, (rgb.extent.y + factor - 1) / factor}, 3);
    for (unsigned y = 0; y < small.extent.y; ++y)
        for (unsigned x = 0; x < small.extent.x; ++x) {
            glm::dvec3 sum(0);
            unsigned count = 0;
            for (unsigned v = y * factor; v < std::min((y + 1) * factor, rgb.extent.y); ++v)
                for (unsigned u = x * factor; u < std::min((x + 1) * factor, rgb.extent.x); ++u, ++count)
                    sum += rgb.rgb(size_t(v) * rgb.extent.x + u);
            small.set_rgb(size_t(y) * small.extent.x + x, glm::vec3(sum / double(count)));
        }
    return small;
}

ReportImage load(const Entry& e, unsigned reduction) {
    ReportImage image{.shot = e.shot,
                      .variant = e.variant,
                      .point = e.point,
                      .kind = e.kind,
                      .target = e.target,
                      .seed = unsigned(e.seed),
                      .data = {}};
    const HostImage rgb = reduced(read_exr_rgb(e.exr), reduction);
    image.width = rgb.extent.x, image.height = rgb.extent.y, image.reduction = reduction;
    image.data = base64(encode_halves(rgb, image.clamped));
    return image;
}

/// Appends the entries of one target as long as they fit into `budget` together; false (and nothing appended)
/// otherwise.
bool append_all(std::vector<ReportImage>& images, const std::vector<Entry>& entries, unsigned reduction,
                size_t& budget) {
    const size_t before = images.size();
    size_t left = budget;
    for (const Entry& e : entries) {
        ReportImage image = load(e, reduction);
        if (image.data.size() > left) {
            images.resize(before);
            return false;
        }
        left -= image.data.size();
        images.push_back(std::move(image));
    }
    budget = left;
    return true;
}

/// Appends references first, then variant points in order, until the budget is spent. Returns how many were left out.
size_t append_some(std::vector<ReportImage>& images, std::vector<Entry> entries, unsigned reduction, size_t& budget) {
    std::ranges::stable_partition(entries, [](const Entry& e) { return e.kind == "reference"; });
    size_t left_out = 0;
    for (const Entry& e : entries) {
        ReportImage image = load(e, reduction);
        if (image.data.size() > budget) {
            ++left_out;
            continue;
        }
        budget -= image.data.size();
        images.push_back(std::move(image));
    }
    return left_out;
}

void check_extents(const std::vector<ReportImage>& images) {
    std::map<std::string, const ReportImage*> first;
    for (const ReportImage& image : images) {
        const ReportImage& other = *first.emplace(image.shot, &image).first->second;
        if (image.width != other.width || image.height != other.height)
            fail("the images of shot ", image.shot, " differ in size: ", image.variant, " ", image.point, " is ",
                 image.width, "x", image.height, ", ", other.variant, " ", other.point, " is ", other.width, "x",
                 other.height);
    }
}

}  // namespace

ReportImages report_images(const std::filesystem::path& folder, const nlohmann::json& manifest,
                           const PointSet& left_out, size_t budget) {
    std::map<int, std::vector<Entry>> by_rank;
    const auto rank = [](const std::string& target) {
        return target == "image" ? 0 : target == "specular" ? 1 : target == "incident" ? 2 : 3;
    };
    std::vector<Entry> entries = first_seeds(read_entries(folder, manifest));
    const bool has_left_out = std::erase_if(entries, [&](const Entry& e) {
                                  return left_out.contains({e.variant, e.point});
                              }) > 0;
    for (Entry& e : entries) {
        const int r = rank(e.target);
        by_rank[r].push_back(std::move(e));
    }
    ReportImages report;
    if (has_left_out)
        report.notes.push_back(
            "The images of points that change one parameter of a baseline are not in this page; the results folder has "
            "them.");
    if (by_rank.empty()) return report;

    const std::vector<Entry>& foremost = by_rank.begin()->second;
    unsigned reduction = 1;
    while (reduction < 8 && !append_all(report.images, foremost, reduction, budget)) reduction *= 2;
    if (reduction > 1)
        report.notes.push_back(
            "To keep this page small, each shown pixel is the mean of " + std::to_string(reduction) + " x " +
            std::to_string(reduction) +
            " pixels; tables and charts use all pixels, and the results folder has the full images.");
    if (reduction == 8)
        if (const size_t left_out = append_some(report.images, foremost, reduction, budget))
            report.notes.push_back(std::to_string(left_out) + " of " + std::to_string(foremost.size()) +
                                   " images are not in this page, to keep it small; the results folder has them.");
    for (auto at = std::next(by_rank.begin()); at != by_rank.end(); ++at)
        if (reduction > 1 || !append_all(report.images, at->second, 1, budget))
            report.notes.push_back("The images of target '" + at->second.front().target +
                                   "' are not in this page, to keep it small; the results folder has them.");
    for (const ReportImage& image : report.images)
        if (image.clamped)
            report.notes.push_back(image.shot + ", " + image.variant + " " + image.point + ": " +
                                   std::to_string(image.clamped) +
                                   " pixels are brighter than 65504, the largest half float, and are shown as that.");
    check_extents(report.images);
    return report;
}

std::vector<unsigned char> encode_halves(const HostImage& rgb, size_t& clamped) {
    const size_t pixels = rgb.pixel_count(), count = pixels * 3;
    std::vector<unsigned char> bytes(2 * count);
    clamped = 0;
    for (size_t i = 0; i < pixels; ++i) {
        bool is_beyond = false;
        for (size_t c = 0; c < 3; ++c) {
            float value = rgb.values[i * 3 + c];
            if (std::isfinite(value) && std::abs(value) > 65504.0f) {
                is_beyond = true;
                value = std::copysign(65504.0f, value);
            }
            const uint16_t bits = half(value).bits();
            bytes[c * pixels + i] = bits & 255;
            bytes[count + c * pixels + i] = bits >> 8;
        }
        clamped += is_beyond;
    }
    for (size_t i = bytes.size(); i-- > 1;) bytes[i] = static_cast<unsigned char>(bytes[i] - bytes[i - 1]);

    uLongf size = compressBound(bytes.size());
    std::vector<unsigned char> packed(size);
    if (compress2(packed.data(), &size, bytes.data(), bytes.size(), 6) != Z_OK)
        fail_machine("not enough memory to compress an image of the report");
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
