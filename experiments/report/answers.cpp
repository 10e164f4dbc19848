#include "experiments/report/answers.h"

#include "experiments/evaluation/interval.h"
#include "experiments/evaluation/standings.h"
#include "experiments/evaluation/study_points.h"
#include "experiments/store/manifest.h"
#include "metrics/temporal.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace {

using nlohmann::json;

/// Three significant digits, as a reader compares them.
std::string shown(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

/// Of a ratio `least_digits`; three near 1, where two would hide on which side it lies.
std::string shown_ratio(double ratio, int least_digits = 2) {
    char text[32];
    if (ratio < 9.95)
        std::snprintf(text, sizeof text, "%.*g", std::max(least_digits, std::abs(ratio - 1) < 0.1 ? 3 : 2), ratio);
    else
        std::snprintf(text, sizeof text, "%.0f", ratio);
    return std::string(text) + "x";
}

std::string interval_text(const std::optional<double>& low, const std::optional<double>& high) {
    return low && high ? " [" + shown(*low) + ", " + shown(*high) + "]" : "";
}

std::string name_of(const AnswerPoint& p) {
    if (!p.label.empty()) return p.label;
    return p.point == "default" || p.point.empty() ? p.variant : p.variant + " " + p.point;
}

std::string with_value(const AnswerPoint& p) {
    return name_of(p) + " (" + shown(p.value) + interval_text(p.low, p.high) + ")";
}

std::string listed(const std::vector<AnswerPoint>& points, size_t most) {
    std::string text;
    for (size_t i = 0; i < std::min(points.size(), most); ++i)
        text += (i == 0 ? "" : i + 1 == points.size() ? " and " : ", ") + name_of(points[i]);
    if (points.size() > most) text += " and " + std::to_string(points.size() - most) + " more";
    return text;
}

/// " Not distinguishable from it: B and C."; empty where there is none such. `most`: are named; `how`: by which test, if
/// that is to be said.
std::string tied_sentence(const std::vector<AnswerPoint>& tied, size_t most, const std::string& how = "") {
    if (tied.empty()) return "";
    return " Not distinguishable from it" + (how.empty() ? "" : " (" + how + ")") + ": " + listed(tied, most) + ".";
}

/// What one shot's points scored, and how long they took.
struct Scored {
    AnswerPoint point;
    const MetricSummary* error = nullptr;
    const TimeSummary* time = nullptr;  ///< of all its stages; null: not timed
    bool is_ranked() const { return error->holds_all_noise && error->low && error->high; }
};

bool is_same(const AnswerPoint& a, const AnswerPoint& b) { return a.variant == b.variant && a.point == b.point; }

/// A quotient with its 95 % interval.
struct Ratio {
    double value;
    std::optional<double> low, high;
};
/// By the ends of both intervals: wider than one of pairs would be, and so on the safe side.
Ratio ratio_of(const TimeSummary& a, const TimeSummary& b) {
    return {a.median / b.median, a.low / b.high, a.high / b.low};
}
/// Of a point to the best one, as they were paired; without an interval where they were not.
Ratio over_best(const Scored& s, const AnswerPoint& best) {
    if (s.error->over_best) return {*s.error->over_best, s.error->over_best_low, s.error->over_best_high};
    return {s.point.value / best.value, {}, {}};
}
Ratio inverse(const Ratio& r) {
    const auto inverted = [](const std::optional<double>& v) {
        return v && *v > 0 ? std::optional(1 / *v) : std::nullopt;
    };
    return {1 / r.value, inverted(r.high), inverted(r.low)};
}
/// With a third digit where two would show an interval as a point.
std::string shown(const Ratio& r) {
    if (!r.low || !r.high) return shown_ratio(r.value);
    const int digits = shown_ratio(*r.low) == shown_ratio(*r.high) ? 3 : 2;
    return shown_ratio(r.value, digits) + " [" + shown_ratio(*r.low, digits) + ", " + shown_ratio(*r.high, digits) +
           "]";
}

std::optional<AnswerPoint> limit_of(const json& manifest, const std::string& shot, const Headline& headline) {
    for (const json& entry : manifest.value("shots", json::array())) {
        if (!entry.is_object() || entry.value("shot", "") != shot) continue;
        for (const json& rung : entry.value("truth_ladder", json::array()))
            if (rung.value("rung", "") == "on_screen" && rung.value("target", "") == headline.target &&
                rung.value("metric", "") == headline.metric && rung.value("mask", "") == headline.mask &&
                rung.contains("value") && rung["value"].is_number()) {
                AnswerPoint limit{"truth ladder", "on_screen", rung["value"], {}, {}};
                read_json(rung.value("low", json()), limit.low), read_json(rung.value("high", json()), limit.high);
                return limit;
            }
    }
    return {};
}

std::vector<AnswerPoint> front_of(const std::vector<Scored>& scored) {
    std::vector<const Scored*> timed;
    for (const Scored& s : scored)
        if (s.time && is_on_front(*s.error, front::time)) timed.push_back(&s);
    std::ranges::stable_sort(timed, {}, [](const Scored* s) { return s->time->median; });
    std::vector<AnswerPoint> front;
    for (const Scored* s : timed) front.push_back(s->point);
    return front;
}

const Scored& find(const std::vector<Scored>& scored, const AnswerPoint& point) {
    return *std::ranges::find_if(scored, [&](const Scored& s) { return is_same(s.point, point); });
}

/// What a reader must know before a time is believed.
struct ClockRecord {
    double floor = 0;        ///< by which two copies of the same point differed: smaller differences say nothing
    bool is_proven = false;  ///< the clock that timed the shot proved itself
};
ClockRecord clock_of(const json& manifest, const std::string& shot) {
    const json clock = manifest.value("clock", json::object());
    ClockRecord found;
    found.floor = aa_floor(manifest, shot).value_or(0);
    for (const json& proof : clock.value("proofs", json::array()))
        if (std::ranges::count(proof.value("shots", json::array()), json(shot)) > 0)
            found.is_proven = proof.value("verdict", "") == "passed";
    return found;
}

/// " Y takes 0.6x its time at 1.8x the error.": of the front's cheaper points, the one with the least error among those
/// that save a fifth of the time or more, and more than copies of the same point differ by.
std::string cheaper_sentence(const ShotAnswer& answer, const std::vector<Scored>& scored, const ClockRecord& clock) {
    const double worth_while = std::min(0.8, 1 - clock.floor);
    const TimeSummary* own = find(scored, *answer.best).time;
    if (!own || !(own->median > 0)) return "";
    for (auto p = answer.front.rbegin(); p != answer.front.rend(); ++p) {
        const TimeSummary* time = find(scored, *p).time;
        if (time->median > worth_while * own->median || !(answer.best->value > 0)) continue;
        return " " + name_of(*p) + " takes " + shown(ratio_of(*time, *own)) + " its time" +
               (clock.is_proven ? "" : " (timer not validated)") + " at " +
               shown(over_best(find(scored, *p), *answer.best)) + " the error.";
    }
    return " Nothing on the front is faster by a fifth, or by more than copies of one point differ.";
}

std::string limit_sentence(const ShotAnswer& answer) {
    if (!answer.limit) return "";
    const std::string what = " lower bound for any single-frame technique";
    if (answer.limit->low.value_or(answer.limit->value) <= 0)  // noise can leave it below
        return " The" + what + " is not distinguishable from 0.";
    const std::string limit = shown(answer.limit->value) + interval_text(answer.limit->low, answer.limit->high);
    const double least = answer.best->low.value_or(answer.best->value),
                 most = answer.limit->high.value_or(answer.limit->value);
    return least > most ? " The" + what + " is " + limit + "." : " That reaches the" + what + ", " + limit + ".";
}

std::string gain_clause(const ShotAnswer& answer, const std::vector<Scored>& scored) {
    if (!answer.baseline || answer.baseline->variant == answer.best->variant || !(answer.baseline->value > 0))
        return "";
    return ", " + shown(inverse(over_best(find(scored, *answer.baseline), *answer.best))) +
           " that of no reflections (none)";
}

/// "1 seed", of "none: 1 seed".
std::string why_not_ranked(const MetricSummary& e) {
    const std::string none = "none: ";
    if (e.interval.starts_with(none)) return e.interval.substr(none.size());
    return e.interval == interval::seeds ? "its interval holds its seeds alone" : "not repeatable";
}

/// What was measured and is not ranked: said before the verdict where it measures less than the best of those that are.
std::string unranked_text(const ShotAnswer& answer, const std::vector<Scored>& scored, const Headline& headline) {
    if (answer.unranked.empty()) return "";
    const AnswerPoint& least = answer.unranked.front();
    const std::string why = " (" + why_not_ranked(*find(scored, least).error) + ")";
    const std::string measured = name_of(least) + " measures least, " + headline.metric + " " + shown(least.value);
    const std::string points =
        std::to_string(answer.unranked.size()) + " of " + std::to_string(scored.size()) + " points";
    if (!answer.best)
        return "Nothing is ranked, as no " + headline.metric + " of this shot has an interval that holds all noise" +
               why + ": " + measured + ".";
    if (least.value < answer.best->value)
        return measured + ", but is only measured, as are " + points + why + ". Among those that are ranked, ";
    return "";
}

std::string sentence_of(const ShotAnswer& answer, const std::vector<Scored>& scored, const Headline& headline,
                        const ClockRecord& clock) {
    std::string text = unranked_text(answer, scored, headline);
    if (!answer.best) return text;
    const std::string value = ": " + headline.metric + " " + shown(answer.best->value) +
                              interval_text(answer.best->low, answer.best->high) + gain_clause(answer, scored);
    const std::string name = name_of(*answer.best);
    if (scored.size() == 1) return name + " is the only point" + value + "." + limit_sentence(answer);
    if (answer.unranked.size() + 1 == scored.size()) return text + name + " stands alone" + value + ".";
    text += name + (answer.tied.empty() ? " has the least error" : " measures the least error") + value + ".";
    return text + tied_sentence(answer.tied, 3) + cheaper_sentence(answer, scored, clock) + limit_sentence(answer);
}

/// By the standings of the perceptual error, which were decided as those of the physical one were.
std::string perceptual_sentence_of(const ShotAnswer& answer, const std::vector<Scored>& perceived,
                                   const std::string& metric) {
    if (perceived.empty() || !answer.best) return "";
    const auto own = std::ranges::find_if(perceived, [&](const Scored& s) { return is_same(s.point, *answer.best); });
    if (own == perceived.end()) return "";
    const Better better = metric_named(metric).better;
    const auto first =
        std::ranges::min_element(perceived, {}, [&](const Scored& s) { return shortfall(better, s.point.value); });
    const std::string by = "By " + metric + ", which is nearer to what people see, ",
                      own_value = shown(own->point.value) + interval_text(own->point.low, own->point.high);
    if (perceived.size() == 1) return by + own_value + ".";
    if (own->error->standing == standing::best) return by + "it is the best, too: " + own_value + ".";
    if (own == first)
        return by + "it measures best, too: " + own_value +
               (own->error->standing.empty() ? "" : ", not distinguishable from others") + ".";
    if (own->error->standing == standing::behind)
        return by + with_value(first->point) + " is significantly better in paired differences; " +
               name_of(own->point) + " has " + own_value + ".";
    const bool are_ranked = !own->error->standing.empty() && !first->error->standing.empty();
    return by + with_value(first->point) + " measures better" +
           (are_ranked ? ", but is not distinguishable" : ", but is not ranked") + "; " + name_of(own->point) +
           " has " + own_value + ".";
}

}  // namespace

Headline headline_of(const json& manifest, std::span<const MetricSummary> errors) {
    const json primary = manifest.value("primary", json::object());
    Headline headline{primary.value("metric", ""), primary.value("mask", ""), primary.value("target", ""), ""};
    for (const char* name : {"flip", "ssim"})
        if (headline.perceptual_metric.empty() && name != headline.metric &&
            std::ranges::any_of(errors, [&](const MetricSummary& e) { return e.metric == name; }))
            headline.perceptual_metric = name;
    return headline;
}

std::vector<ShotAnswer> shot_answers(const ReportTables& tables, const json& manifest) {
    const Headline headline = headline_of(manifest, tables.errors);
    const PointSet left_out = points_using_scene_data(manifest);
    auto labels = point_labels(manifest);
    std::vector<std::string> shots;
    for (const MetricSummary& e : tables.errors)
        if (std::ranges::count(shots, e.shot) == 0) shots.push_back(e.shot);
    std::vector<ShotAnswer> answers;
    for (const std::string& shot : shots) {
        ShotAnswer answer{.shot = shot, .limit = limit_of(manifest, shot, headline)};
        std::vector<Scored> scored, perceived;
        for (const MetricSummary& e : tables.errors) {
            if (!e.represents_shot || e.shot != shot || e.mask != headline.mask || e.target != headline.target ||
                !e.value || left_out.contains({e.variant, e.point}))
                continue;
            const AnswerPoint point{e.variant, e.point, *e.value, e.low, e.high, labels[{e.variant, e.point}]};
            if (e.metric == headline.metric) {
                const auto time = std::ranges::find_if(tables.times, [&](const TimeSummary& t) {
                    return t.shot == shot && t.variant == e.variant && t.point == e.point && t.stage == "total";
                });
                scored.push_back({point, &e, time == tables.times.end() ? nullptr : &*time});
                if (e.variant == "none" && !answer.baseline) answer.baseline = point;
            }
            if (e.metric == headline.perceptual_metric) perceived.push_back({point, &e});
        }
        if (scored.empty()) continue;
        std::ranges::stable_sort(scored, {}, [](const Scored& s) { return s.point.value; });
        for (const Scored& s : scored) {
            if (!s.is_ranked())
                answer.unranked.push_back(s.point);
            else if (!answer.best)
                answer.best = s.point;
            else if (s.error->standing == standing::tied)
                answer.tied.push_back(s.point);
        }
        answer.front = front_of(scored);
        const ClockRecord clock = clock_of(manifest, shot);
        answer.is_clock_proven = clock.is_proven;
        answer.sentence = sentence_of(answer, scored, headline, clock);
        answer.perceptual_sentence = perceptual_sentence_of(answer, perceived, headline.perceptual_metric);
        answers.push_back(std::move(answer));
    }
    return answers;
}

std::string over_scenes_sentence(const ReportTables& tables, const json& manifest) {
    const Headline headline = headline_of(manifest, tables.errors);
    const auto is_of_headline = [&](const auto& row) {
        return row.target == headline.target && row.metric == headline.metric && row.mask == headline.mask;
    };
    auto labels = point_labels(manifest);
    std::vector<const OverScenesRow*> rows;
    std::vector<AnswerPoint> tied, behind;
    for (const OverScenesRow& row : tables.over_scenes) {
        if (!is_of_headline(row)) continue;
        rows.push_back(&row);
        const AnswerPoint point{row.variant, row.point, row.ratio, row.low, row.high, labels[{row.variant, row.point}]};
        if (row.rank && rows.size() > 1 && row.standing == standing::tied) tied.push_back(point);
        if (row.standing == standing::behind) behind.push_back(point);
    }
    if (rows.empty()) return "";
    const OverScenesRow& first = *rows.front();  // those that are ranked come first
    if (!first.rank) return "Over scenes nothing is ranked: no shot has an error of every point.";
    std::set<std::string> scenes;
    for (const MetricSummary& e : tables.errors)
        if (is_of_headline(e)) scenes.insert(asset_of(manifest, e.shot));
    if (scenes.size() == 1) return "One scene is too few for a verdict over scenes, which takes four.";
    const auto named = [&](const std::string& variant, const std::string& point) {
        return name_of(AnswerPoint{.variant = variant, .point = point, .label = labels[{variant, point}]});
    };
    const std::string baseline =
                          (first.baseline_variant == "none" ? "no reflections (none)"
                                                            : named(first.baseline_variant, first.baseline_point)),
                      name = named(first.variant, first.point);
    const bool is_baseline = first.variant == first.baseline_variant && first.point == first.baseline_point;
    const std::string over = "Over " + std::to_string(first.scenes) +
                             (first.scenes < scenes.size() ? " of " + std::to_string(scenes.size()) : "") + " scenes ",
                      error = ": " + shown(Ratio{first.ratio, first.low, first.high}) + " that of " + baseline,
                      mean = " (geometric mean of " + headline.metric + ")",
                      measured = (is_baseline ? "" : error) + mean + ".";
    if (first.scenes < least_scenes)
        return over + name + " measures the least error" + measured + " " + std::to_string(first.scenes) +
               (first.scenes == 1 ? " scene is" : " scenes are") +
               " too few for an interval and a verdict, which take four.";
    std::string text = first.standing == standing::best
                           ? over + name + " has the least error" + measured
                           : over + "no technique is significantly the best. " + name + " measures the least error" +
                                 measured + tied_sentence(tied, 2, "adjusted for all comparisons");
    if (!behind.empty())
        text += " It is significantly better than " + (tied.empty() ? "all others" : listed(behind, 3)) + ".";
    return text;
}

json answers_json(const std::vector<ShotAnswer>& answers, const Headline& headline) {
    const auto point_json = [](const AnswerPoint& p) {
        return json{{"variant", p.variant},
                    {"point", p.point},
                    {"value", p.value},
                    {"low", column_json(p.low)},
                    {"high", column_json(p.high)}};
    };
    const auto optional_json = [&](const std::optional<AnswerPoint>& p) { return p ? point_json(*p) : json(); };
    json list = json::array();
    for (const ShotAnswer& a : answers) {
        const auto points_json = [&](const std::vector<AnswerPoint>& points) {
            json all = json::array();
            for (const AnswerPoint& p : points) all.push_back(point_json(p));
            return all;
        };
        list.push_back({{"shot", a.shot},
                        {"sentence", a.sentence},
                        {"perceptual_sentence", a.perceptual_sentence},
                        {"metric", headline.metric},
                        {"mask", headline.mask},
                        {"target", headline.target},
                        {"perceptual_metric", headline.perceptual_metric},
                        {"best", optional_json(a.best)},
                        {"tied", points_json(a.tied)},
                        {"unranked", points_json(a.unranked)},
                        {"baseline", optional_json(a.baseline)},
                        {"limit", optional_json(a.limit)},
                        {"is_clock_proven", a.is_clock_proven},
                        {"front", points_json(a.front)}});
    }
    return list;
}
