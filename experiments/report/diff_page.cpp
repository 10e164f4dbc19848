#include "experiments/report/diff_page.h"

#include "core/files.h"
#include "experiments/report/report.h"
#include "experiments/report/report_data.h"
#include "experiments/report/report_images.h"
#include "experiments/results/files/targets.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

namespace {

using nlohmann::json;

/// The entries of a manifest for result images, by the point that they are of, and for references (technique and point
/// "").
std::map<PointOfShot, std::vector<const json*>> images_of(const json& manifest) {
    std::map<PointOfShot, std::vector<const json*>> images;
    if (!manifest.contains("images")) return images;
    for (const json& image : manifest["images"]) {
        const std::string kind = image.value("kind", ""), shot = image.value("shot", "");
        if (kind == "reference") images[{shot, "", ""}].push_back(&image);
        if (kind == "result") images[{shot, image.value("technique", ""), image.value("point", "")}].push_back(&image);
    }
    return images;
}

/// What both studies have of a point in a shot.
struct DiffPoint {
    PointOfShot name;
    std::vector<const NumberChange*> numbers;  ///< errors, then the time
    double largest_change = 0;                 ///< of those that changed
    std::string images;                        ///< "equal", "differ", or "none" where a study has none

    /// Whether an error is another, or a time has changed: two times are never equal.
    bool is_changed() const {
        return std::ranges::any_of(numbers, [](const NumberChange* c) {
            return c->target.empty() ? c->verdict == change::changed : c->verdict != change::equal;
        });
    }
};

std::string shot_in(const std::string& shot, const char* run) { return shot + " (" + run + ")"; }

/// The images of the page. Shots are named after their run, too.
class DiffImages {
public:
    DiffImages(const ComparedStudy& before, const ComparedStudy& after, std::string target)
        : studies_{{{&before, "old", images_of(before.manifest)}, {&after, "new", images_of(after.manifest)}}},
          target_(std::move(target)) {}

    /// As DiffPoint::images.
    std::string compared(const PointOfShot& point) const {
        const auto a = hashes(studies_[0], point), b = hashes(studies_[1], point);
        return a.empty() || b.empty() ? "none" : a == b ? "equal" : "differ";
    }

    /// Adds both results of the point, and what they were measured against; false: there is no room.
    bool add(const PointOfShot& point) {
        const auto& [shot, technique, name] = point;
        const bool has_truth = !shots_.insert(shot).second, is_same_truth = truth_of(0, shot) == truth_of(1, shot);
        std::array<ReportImages, 2> found;
        size_t size = 0;
        for (size_t run = 0; run < 2; ++run) {
            const Study& study = studies_[run];
            json wanted = json::array();
            for (const PointOfShot& of : {PointOfShot{shot, "", ""}, point}) {
                const bool is_truth = of != point;
                if (is_truth && (has_truth || (run == 1 && is_same_truth))) continue;
                for (const json* image : entries(study, of))
                    if (image->value("target", "") == target_) wanted.push_back(*image);
            }
            found[run] = embedded_images(study.of->folder, {{"images", wanted}});
            for (const std::string& data : found[run].data) size += data.size();
            for (json& description : found[run].descriptions) description["shot"] = shot_in(shot, study.run);
        }
        if (size_ + size > page_bytes) return false;
        size_ += size;
        for (ReportImages& own : found) {
            all.descriptions.insert(all.descriptions.end(), own.descriptions.begin(), own.descriptions.end());
            std::ranges::move(own.data, std::back_inserter(all.data));
            std::ranges::move(own.notes, std::back_inserter(all.notes));
        }
        return true;
    }

    ReportImages all = {};

private:
    struct Study {
        const ComparedStudy* of;
        const char* run;
        std::map<PointOfShot, std::vector<const json*>> images;
    };

    static const std::vector<const json*>& entries(const Study& study, const PointOfShot& point) {
        static const std::vector<const json*> none;
        const auto found = study.images.find(point);
        return found == study.images.end() ? none : found->second;
    }

    /// Of the files, by what they show.
    static std::map<std::string, std::string> hashes(const Study& study, const PointOfShot& point) {
        std::map<std::string, std::string> found;
        for (const json* image : entries(study, point))
            found[image->value("target", "") + " " + std::to_string(image->value("frame", 0)) + " " +
                  std::to_string(image->value("seed", 0))] = image->value("exr_hash", "");
        return found;
    }

    std::map<std::string, std::string> truth_of(size_t run, const std::string& shot) const {
        return hashes(studies_[run], {shot, "", ""});
    }

    std::array<Study, 2> studies_;
    std::string target_;
    std::set<std::string> shots_;  ///< those whose truth the page has
    size_t size_ = 0;
};

/// All points that both studies measured; first those that changed, by their largest change.
std::vector<DiffPoint> points_of(const StudyDiff& diff, const DiffImages& images) {
    std::vector<DiffPoint> points;
    std::map<PointOfShot, size_t> places;
    for (const auto* changes : {&diff.errors, &diff.times})
        for (const NumberChange& c : *changes) {
            const auto [at, is_new] = places.try_emplace({c.shot, c.technique, c.point}, points.size());
            if (is_new) points.push_back({.name = at->first, .numbers = {}, .images = images.compared(at->first)});
            DiffPoint& point = points[at->second];
            point.numbers.push_back(&c);
            if (c.verdict == change::changed) point.largest_change = std::max(point.largest_change, c.size());
        }
    std::ranges::stable_sort(points, std::greater{}, [](const DiffPoint& p) {
        return std::tuple(p.largest_change, p.images == "differ", p.is_changed());
    });
    return points;
}

/// How often each verdict was given to a technique's numbers.
json verdict_counts(const std::vector<NumberChange>& errors) {
    std::map<std::string, std::vector<NumberChange>> by_technique;
    for (const NumberChange& c : errors) by_technique[c.technique].push_back(c);
    json counts = json::array();
    for (const auto& [technique, own] : by_technique) {
        json row = {{"technique", technique}, {"numbers", own.size()}};
        for (const char* verdict :
             {change::equal, change::equivalent, change::undecided, change::changed, change::not_judged})
            row["verdicts"].push_back({{"verdict", verdict}, {"count", count_of(own, verdict)}});
        counts.push_back(row);
    }
    return counts;
}

/// What the viewer asks of a manifest: how shots are exposed, and how points are named.
json merged_manifest(const json& before, const json& after) {
    json shots = json::array(), techniques = after.value("techniques", json::array());
    for (const auto& [manifest, run] : {std::pair(&before, "old"), std::pair(&after, "new")})
        for (const json& shot : manifest->value("shots", json::array())) {
            json own = {{"shot", shot_in(shot.value("shot", ""), run)},
                        {"exposure_ev", shot.value("exposure_ev", 0.0)}};
            if (shot.contains("label")) own["label"] = shot_in(shot["label"].get<std::string>(), run);
            shots.push_back(own);
        }
    return {{"shots", shots}, {"techniques", techniques}};
}

}  // namespace

void write_diff_page(const std::filesystem::path& page, const StudyDiff& diff, const ComparedStudy& before,
                     const ComparedStudy& after) {
    const std::string target = after.manifest.value("primary", json::object()).value("target", "specular");
    DiffImages images(before, after, is_ladder_rung(target) ? "incident" : target);
    json points = json::array();
    size_t without_room = 0;
    bool has_room = true;
    for (const DiffPoint& point : points_of(diff, images)) {
        if (!point.is_changed() && point.images != "differ") continue;
        has_room = has_room && (point.images == "none" || images.add(point.name));
        without_room += !has_room;
        json numbers = json::array();
        for (const NumberChange* c : point.numbers)
            if (c->verdict != change::equal) numbers.push_back(row_json(*c));
        const size_t equal = point.numbers.size() - numbers.size();
        points.push_back({{"shot", point.name[0]},
                          {"technique", point.name[1]},
                          {"point", point.name[2]},
                          {"images", point.images},
                          {"numbers", std::move(numbers)},
                          {"equal", equal}});
    }
    json moved = json::array();
    for (const MovedShot& m : diff.moved) moved.push_back({m.shot, m.before, m.after});
    json data = report_data({}, {}, {});
    data["warnings"] = json::array(), data["defaults"] = json::object();
    data["manifest"] = merged_manifest(before.manifest, after.manifest);
    data["is_study"] = false;
    data["diff"] = {{"before", before.folder.string()},
                    {"after", after.folder.string()},
                    {"target", target},
                    {"changed", count_of(diff.errors, change::changed)},
                    {"compared", diff.errors.size()},
                    {"changed_times", count_of(diff.times, change::changed)},
                    {"compared_times", diff.times.size()},
                    {"moved", moved},
                    {"counts", verdict_counts(diff.errors)},
                    {"points", points},
                    {"without_room", without_room},
                    {"only_before", diff.only_before},
                    {"only_after", diff.only_after}};
    json values = {{"is_diff", true},
                   {"tables", "results.csv and summary.csv of both folders"},
                   {"warnings",
                    {std::to_string(count_of(diff.errors, change::changed)) + " of " +
                     std::to_string(diff.errors.size()) + " errors changed from " + before.folder.string() + " to " +
                     after.folder.string() + "; `ssrlab diff` lists them."}}};
    write_text(page, report_page("diff", "What changed", script_text(data), images.all, values));
}
