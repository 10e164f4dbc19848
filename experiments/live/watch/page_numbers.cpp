#include "experiments/live/watch/page_numbers.h"

#include "core/error.h"
#include "core/json.h"
#include "experiments/gpu_costs/chips/model_range.h"
#include "experiments/results/cells/image_path.h"
#include "experiments/results/verdicts/judgement.h"
#include "experiments/results/verdicts/study_results.h"
#include "experiments/study/measuring/rays/error_causes.h"
#include "experiments/study/shots/result_images.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

const PointName no_reflections = {"none", "default"};

/// The primary error of these studies.
const PrimaryComparisons primary;

template <class Row>
PointName name_of(const Row& row) {
    return {row.technique, row.point};
}

json verdict_on(const StudyResults& tables, const PointName& point, const PointName& against,
                const std::string& label) {
    json said = {{"label", label}, {"verdict", ""}, {"why", ""}, {"views", json::array()}};
    if (measure_alike(tables.results, point, against)) {
        said["verdict"] = judgement::identical;
        return said;
    }
    try {
        const Judgement judged = judge_effects(tables.effects, primary, point, against);
        said["verdict"] = judged.verdict;
        for (const JudgedView& view : judged.views)
            said["views"].push_back({{"shot", view.shot},
                                     {"ratio", view.change},
                                     {"low", view.low},
                                     {"high", view.high},
                                     {"p_holm", view.p_holm},
                                     {"detectable", view.detectable},
                                     {"verdict", view.verdict}});
    } catch (const MachineError&) {
        throw;
    } catch (const Error& e) {
        said["why"] = e.what();
    }
    return said;
}

/// By label and target the images of a shot that the page can lay beside each other.
json images_of(const fs::path& results, const json& manifest, const std::string& shot,
               const std::map<PointName, std::string>& labels, PageImages& images) {
    json found = json::object();
    for (const json& entry : manifest.value("images", json::array())) {
        const std::string kind = entry.value("kind", ""), target = entry.value("target", "");
        if (entry.value("shot", "") != shot || (target != "image" && target != "specular")) continue;
        std::string label = kind == "reference" ? "truth" : "";
        if (kind == "result")
            if (const auto known = labels.find({entry.value("technique", ""), entry.value("point", "")});
                known != labels.end())
                label = known->second;
        if (label.empty()) continue;
        found[label][target] = images.add(image_path(results, entry.value("exr", "")));
    }
    return found;
}

}  // namespace

json page_numbers(const fs::path& results, const WatchedPoint& point, const std::vector<WatchedPoint>& against,
                  PageImages& images) {
    const StudyResults tables = read_study_results(results);
    const PointName name = point.name();
    std::map<PointName, std::string> labels = {{name, "now"}, {no_reflections, "no reflections"}};
    json verdicts = json::array();
    for (const WatchedPoint& other : against) {
        labels[other.name()] = other.label;
        verdicts.push_back(verdict_on(tables, name, other.name(), other.label));
    }
    verdicts.push_back(verdict_on(tables, name, no_reflections, "no reflections"));
    std::map<std::string, json> of_others;  // by shot
    json shots = json::array();
    for (const MetricSummary& e : tables.summary) {
        if (e.metric != primary.metric || e.mask != primary.mask || e.target != primary.target) continue;
        if (name_of(e) == name)
            shots.push_back({{"shot", e.shot},
                             {"error", row_json(e)},
                             {"images", images_of(results, tables.manifest, e.shot, labels, images)}});
        else if (const auto known = labels.find(name_of(e)); known != labels.end())
            of_others.try_emplace(e.shot, json::array())
                .first->second.push_back({{"label", known->second}, {"error", row_json(e)}});
    }
    for (json& shot : shots)
        shot["others"] = of_others.try_emplace(shot["shot"].get<std::string>(), json::array()).first->second;
    return {{"shots", shots}, {"verdicts", verdicts}};
}

json page_why(const fs::path& results, const WatchedPoint& point, PageImages& images) {
    const StudyResults tables = read_study_results(results, Runs::left_out);
    const PointName name = point.name();
    json why = {{"causes", json::array()}, {"rays", json::array()}, {"hits", json::object()}};
    for (const HitRow& h : tables.hits) {
        if (name_of(h) != name || h.mask != primary.mask) continue;
        const std::string of_error = "error: ";
        if (h.stage == error_stage && h.quantity.starts_with(of_error))
            why["causes"].push_back({{"cause", h.quantity.substr(of_error.size())}, {"share", h.value}});
        else if (std::ranges::count(ray_verdict_names(), h.quantity) > 0)
            why["rays"].push_back({{"stage", h.stage}, {"verdict", h.quantity}, {"share", h.value}});
    }
    for (const json& entry : tables.manifest.value("images", json::array()))
        if (entry.value("kind", "") == "hits" &&
            PointName(entry.value("technique", ""), entry.value("point", "")) == name)
            why["hits"][entry.value("target", "")] = images.add(image_path(results, entry.value("exr", "")), true);
    return why;
}

json page_times(const fs::path& results, const WatchedPoint& point, const std::vector<WatchedPoint>& against) {
    const StudyResults tables = read_study_results(results, Runs::left_out);
    const PointName name = point.name();
    json times = {{"stages", json::array()},
                  {"effects", json::array()},
                  {"estimates", json::array()},
                  {"model_range", model_range_text()}};
    for (const TimeSummary& t : tables.time_summary)
        if (name_of(t) == name) times["stages"].push_back(row_json(t));
    for (const TimeEffectRow& t : tables.time_effects) {
        if (name_of(t) != name || t.stage != "total") continue;
        for (const WatchedPoint& other : against)
            if (other.name() == PointName(t.against_technique, t.against_point)) {
                times["effects"].push_back(row_json(t));
                times["effects"].back()["label"] = other.label;
            }
    }
    for (const EstimateRow& e : tables.estimates)
        if (name_of(e) == name) times["estimates"].push_back(row_json(e));
    return times;
}
