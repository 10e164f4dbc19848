#include "experiments/results/answers/cause_and_cure.h"

#include "core/list_text.h"
#include "core/number_text.h"
#include "experiments/results/answers/answer_text.h"
#include "experiments/results/verdicts/interval.h"
#include "experiments/results/verdicts/power.h"
#include "metrics/direction.h"
#include "metrics/noise.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using nlohmann::json;

/// Why a point is not ranked.
enum class Cause { seeds, reference, runs };

bool is_ranked_point(const MetricSummary& e) { return e.ranked && e.low && e.high; }

Cause cause_of(const MetricSummary& e) {
    if (e.interval == interval::one_seed || e.interval == interval::too_few_seeds) return Cause::seeds;
    if (e.interval == interval::seeds || e.interval.starts_with("none")) return Cause::reference;
    return Cause::runs;  // an interval that does not hold how results differ from run to run
}

std::string point_name(const MetricSummary& e, const PointLabels& labels) {
    const auto label = labels.find({e.technique, e.point});
    return name_of(
        AnswerPoint{.technique = e.technique, .point = e.point, .label = label == labels.end() ? "" : label->second});
}

std::string listed_points(const std::vector<const MetricSummary*>& points, const PointLabels& labels) {
    return listed(names_of(points, [&](const MetricSummary* e) { return point_name(*e, labels); }), 2);
}

/// Two significant digits, and whole numbers from 10 on.
std::string share_text(double share) {
    if (share > 10) return "more than 1000 %";
    return share < 0.0995 ? percent_text(share, 2) : fixed_text(100 * share) + " %";
}

double number_at(const json& object, const char* key) {
    return object.is_object() && object.contains(key) && object[key].is_number() ? object[key].get<double>() : 0;
}

/// " 1 % of the pixels hold 84 % of the reference's noise. Surfaces of roughness 0 to 0.1 hold 92 % of this noise."
std::string places_sentences(const json& noise) {
    const double share = number_at(noise, "noisiest_share");
    if (!(share > 0)) return "";
    std::string text = " 1 % of the pixels hold " + share_text(share) + " of the reference's noise.";
    const json none = json::array(), &classes = noise.contains("by_roughness") ? noise["by_roughness"] : none;
    const auto most =
        std::ranges::max_element(classes, {}, [](const json& c) { return number_at(c, "variance_share"); });
    if (most == classes.end() || classes.size() < 2) return text;
    return text + " Surfaces of roughness " + number_text(number_at(*most, "from"), 2) + " to " +
           number_text(number_at(*most, "below"), 2) + " hold " + share_text(number_at(*most, "variance_share")) +
           " of this noise.";
}

/// The counts that references have: 16 x 2^k.
double reference_count(double samples) { return 16 * std::exp2(std::ceil(std::log2(std::max(samples / 16, 1.0)))); }

std::string reference_sentences(const JudgedShot& shot, const std::vector<const MetricSummary*>& points) {
    const MetricSummary& first = *points.front();
    if (!first.floor) return " This shot's reference came without halves, so its noise is unknown.";
    if (first.metric.find("ssim") != std::string::npos)
        return " No number of samples gives " + first.metric + " an interval.";
    const double samples = number_at(shot.reference, "samples_median");
    std::string text = places_sentences(shot.reference.is_object() ? shot.reference.value("noise", json()) : json());
    if (first.interval != interval::few_paths || !(samples > 0)) return text;
    double needed = samples_needed(samples);
    if (double(first.pixels) * samples < least_noise_samples) {
        text = " The mask " + first.mask + " holds only " + std::to_string(first.pixels) +
               (first.pixels == 1 ? " pixel." : " pixels.");
        needed = reference_count(least_noise_samples / double(std::max<size_t>(first.pixels, 1)));
    }
    return text + " About " + fixed_text(needed) + " samples per pixel (reference.samples) would give " + first.metric +
           (points.size() == 1 ? " an interval" : " intervals") + ". This reference has " + fixed_text(samples) +
           " samples per pixel.";
}

/// " flip already ranks all 4 points."
std::string deciding_sentence(const JudgedShot& shot, size_t ranked_by_own) {
    std::map<std::string, std::pair<size_t, size_t>> metrics;  // ranked points, and all
    for (const MetricSummary* e : shot.errors) {
        if (!direction_of(e->metric) || e->metric == shot.metric) continue;
        auto& [ranked, all] = metrics[e->metric];
        ranked += !e->standing.empty(), ++all;
    }
    const auto best = std::ranges::max_element(
        metrics, {}, [](const auto& m) { return std::pair(m.second.first, m.first == "flip"); });
    if (best == metrics.end())
        return shot.metric == "flip" ? "" : " Add flip to the metrics: flip needs few samples for an interval.";
    const auto& [name, counts] = *best;
    if (counts.first < 2 || counts.first <= ranked_by_own) return "";
    return " " + name + " already ranks " +
           (counts.first == counts.second ? "all " + std::to_string(counts.first)
                                          : std::to_string(counts.first) + " of " + std::to_string(counts.second)) +
           " points.";
}

std::string of_largest_sentence(const VisibleDifference& visible, const std::string& name) {
    const bool is_far_worse =
        visible.largest > 1.5 * visible.typical && share_text(visible.largest) != share_text(visible.typical);
    return is_far_worse ? " For " + name + " this difference is " + share_text(visible.largest) + "." : "";
}

}  // namespace

double samples_needed(double samples) { return reference_count(2 * samples); }

std::string cure_sentences(const JudgedShot& shot) {
    std::map<Cause, std::vector<const MetricSummary*>> unranked;
    size_t ranked = 0;
    for (const MetricSummary* e : shot.errors) {
        if (e->metric != shot.metric) continue;
        if (is_ranked_point(*e))
            ++ranked;
        else
            unranked[cause_of(*e)].push_back(e);
    }
    if (unranked.empty()) return "";
    std::string text;
    if (const auto& points = unranked[Cause::reference]; !points.empty()) text += reference_sentences(shot, points);
    if (const auto& points = unranked[Cause::seeds]; !points.empty())
        text += " Run with seeds: 4 to rank " + listed_points(points, shot.labels) + ".";
    if (const auto& points = unranked[Cause::runs]; !points.empty())
        text += " No number of seeds ranks " + listed_points(points, shot.labels) +
                ", because results differ from run to run.";
    return text + deciding_sentence(shot, ranked);
}

std::string power_sentence(const JudgedShot& shot) {
    std::vector<const MetricSummary*> ranked;
    for (const MetricSummary* e : shot.errors)
        if (e->metric == shot.metric && !e->standing.empty()) ranked.push_back(e);
    const auto visible = visible_in_shot(ranked, shot.comparisons);
    if (!visible) return "";
    const auto largest = std::ranges::find_if(
        ranked, [&](const MetricSummary* e) { return PointName(e->technique, e->point) == visible->of_largest; });
    return " A study like this detects a difference of " + share_text(visible->typical) +
           " from the best in 8 of 10 cases." + of_largest_sentence(*visible, point_name(**largest, shot.labels));
}

std::string power_over_scenes_sentence(std::span<const OverScenesRow* const> rows) {
    const auto visible = visible_over_scenes(rows);
    const auto needed = scenes_needed_for(rows);
    if (!visible || !needed) return "";
    return " A study like this detects a difference of " + share_text(visible->typical) +
           " in 8 of 10 cases. Detecting " + share_text(worth_deciding) + " takes " + fixed_text(*needed) + " scenes.";
}

std::string deciding_over_scenes_sentence(std::span<const OverScenesRow> rows, const OverScenesRow& unranked) {
    for (const OverScenesRow& row : rows)
        if (row.rank && row.metric != unranked.metric && row.mask == unranked.mask && row.target == unranked.target)
            return " " + row.metric + " ranks points over scenes (over_scenes.csv).";
    return "";
}
