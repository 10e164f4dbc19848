#include "experiments/results/answers/scenes_answer.h"

#include "core/list_text.h"
#include "core/number_text.h"
#include "experiments/results/answers/answer_text.h"
#include "experiments/results/answers/cause_and_cure.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/verdicts/standings.h"
#include "experiments/results/verdicts/study_points.h"

#include <algorithm>
#include <map>
#include <set>

namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

constexpr size_t most_named = 3;
constexpr double worth_naming = 0.02;  // of a probability

/// Names of the shots' scenes; where several shots are of one scene, those of the shots.
std::map<std::string, std::string> scene_names(const std::vector<ShotAnswer>& answers, const json& manifest) {
    std::map<std::string, std::string> names;
    std::map<std::string, size_t> counts;
    for (const ShotAnswer& a : answers) {
        const std::string scene = shot_entry(manifest, a.shot).value("scene", "");
        names[a.shot] = scene.empty() ? a.shot : scene;
    }
    for (const auto& [shot, name] : names) ++counts[name];
    for (auto& [shot, name] : names)
        if (counts[name] > 1) name = shot;
    return names;
}

/// Alone, "none" would read as if there were no such point.
std::string said_name(const AnswerPoint& point) {
    return point.technique == "none" ? "no reflections (none)" : name_of(point);
}

/// Points in the order in which they first appear, each with the shots that it is said of.
class ByPoint {
public:
    void add(const AnswerPoint& point, const std::string& where) {
        const std::string name = said_name(point);
        auto at = std::ranges::find(found_, name, [](const auto& entry) { return entry.first; });
        if (at == found_.end()) at = found_.insert(at, {name, {}});
        at->second.push_back(where);
    }
    /// "A in x and y; B in z".
    std::string text() const {
        std::string text;
        for (const auto& [name, where] : found_)
            text += (text.empty() ? "" : "; ") + name + " in " + listed(where, most_named);
        return text;
    }
    /// Those that are said of `count` shots.
    Names of(size_t count) const {
        Names names;
        for (const auto& [name, where] : found_)
            if (where.size() == count) names.push_back(name);
        return names;
    }
    bool is_empty() const { return found_.empty(); }

private:
    std::vector<std::pair<std::string, Names>> found_;
};

/// "A 0.68, B 0.28": probabilities; the largest is named in any case.
std::string chances_text(std::vector<const OverScenesRow*> rows, std::optional<double> OverScenesRow::*chance,
                         const std::map<PointName, std::string>& names) {
    std::ranges::stable_sort(rows, std::greater{}, [&](const OverScenesRow* r) { return (r->*chance).value_or(0); });
    Names parts;
    for (const OverScenesRow* r : rows)
        if (r->*chance && (parts.empty() || (parts.size() < most_named && *(r->*chance) >= worth_naming)))
            parts.push_back(names.at({r->technique, r->point}) + " " + probability_text(*(r->*chance)));
    return joined(parts);
}

}  // namespace

std::string in_these_scenes(const std::vector<ShotAnswer>& answers, const json& manifest, const Headline& headline) {
    const auto names = scene_names(answers, manifest);
    ByPoint first, near, behind;
    size_t ranked = 0;
    for (const ShotAnswer& a : answers) {
        if (!a.best || a.others() == 0) continue;
        ++ranked;
        const std::string& where = names.at(a.shot);
        first.add(*a.best, where);
        for (const AnswerPoint& p : a.near) near.add(p, where);
        if (a.baseline && std::ranges::any_of(a.behind, [&](auto& p) { return name_of(p) == name_of(*a.baseline); }))
            behind.add(*a.baseline, where);
        for (const AnswerPoint& p : a.behind)
            if (!a.baseline || name_of(p) != name_of(*a.baseline)) behind.add(p, where);
    }
    if (answers.size() < 2) return "";
    const std::string count = std::to_string(answers.size()), all = "In these " + count + " shots ";
    if (ranked == 0) return all + "nothing is ranked by " + headline.metric + ".";
    std::string text =
        (ranked < answers.size() ? "In " + std::to_string(ranked) + " of these " + count + " shots " : all) +
        "these points have the least " + headline.metric + ": " + first.text() + ".";
    if (!near.is_empty())
        text += " Certainly within " + percent_text(headline.margin) + " of the least: " + near.text() + ".";
    if (const Names everywhere = behind.of(ranked); !everywhere.empty())
        text += " Certainly worse in each of these shots: " + listed(everywhere, most_named) + ".";
    return text;
}

std::string in_scenes_like_these(const StudyResults& tables) {
    const json& manifest = tables.manifest;
    const Headline headline = headline_of(manifest, tables.summary);
    const auto is_of_headline = [&](const auto& row) {
        return row.target == headline.target && row.metric == headline.metric && row.mask == headline.mask;
    };
    auto labels = point_labels(manifest);
    std::map<PointName, std::string> names;
    std::vector<const OverScenesRow*> rows;
    Names near, behind;
    for (const OverScenesRow& row : tables.over_scenes) {
        if (!is_of_headline(row)) continue;
        const AnswerPoint point{row.technique, row.point, row.ratio,
                                row.low,       row.high,  labels[{row.technique, row.point}]};
        const std::string& name = names[{row.technique, row.point}] = said_name(point);
        rows.push_back(&row);
        if (!row.rank || rows.size() == 1) continue;
        if (row.standing == standing::behind) behind.push_back(name);
        if (row.standing == standing::equivalent) near.push_back(name);
    }
    if (rows.empty()) return "";
    const OverScenesRow& first = *rows.front();  // those that are ranked come first
    if (!first.rank)
        return "Nothing is ranked over scenes: no shot has an error of every point." +
               deciding_over_scenes_sentence(tables.over_scenes, first);
    std::set<std::string> shots, scenes;
    for (const MetricSummary& e : tables.summary)
        if (is_of_headline(e)) shots.insert(e.shot);
    for (const std::string& shot : shots) scenes.insert(asset_of(manifest, shot));
    if (scenes.size() == 1)
        return "One scene says nothing about other scenes: a verdict over scenes needs at least " +
               std::to_string(least_scenes) + ".";
    const std::string name = names.at({first.technique, first.point}), count = std::to_string(first.scenes);
    if (rows.size() == 1 || !rows[1]->rank)
        return "Nothing is ranked over scenes: " + name + " alone has an error in each of these scenes.";
    if (first.scenes < least_scenes)
        return count + (first.scenes == 1 ? " scene says" : " scenes say") +
               " nothing about other scenes: a verdict over scenes needs at least " + std::to_string(least_scenes) +
               ". In these scenes " + name + " has the least error on average.";
    const bool is_baseline = first.technique == first.baseline_technique && first.point == first.baseline_point;
    const AnswerPoint baseline{first.baseline_technique,
                               first.baseline_point,
                               1,
                               {},
                               {},
                               labels[{first.baseline_technique, first.baseline_point}]};
    const std::string gain =
        is_baseline ? ""
                    : ": " + shown(Ratio{first.ratio, first.low, first.high}) + " the " + headline.metric + " of " +
                          said_name(baseline) + ", geometric mean over " + count +
                          (first.scenes < scenes.size() ? " of " + std::to_string(scenes.size()) : "") + " scenes";
    std::string text = "In scenes like these " + name;
    if (first.standing == standing::best) return text + " certainly has the least error on average" + gain + ".";
    text += " measures the least error on average" + gain +
            ". Probability of the least mean error: " + chances_text(rows, &OverScenesRow::chance_first, names) +
            ". Probability of a mean error within " + percent_text(near_first) +
            " of the least: " + chances_text(rows, &OverScenesRow::chance_near, names) + ".";
    if (!near.empty())
        text += " Certainly within " + percent_text(headline.margin) + " of " + name + ": " + listed(near, most_named) +
                ".";
    text += behind.empty() ? " No point is certainly worse." : " Certainly worse: " + listed(behind, most_named) + ".";
    std::erase_if(rows, [](const OverScenesRow* row) { return !row->rank; });
    return text + power_over_scenes_sentence(rows);
}
