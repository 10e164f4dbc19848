#include "experiments/report/answers.h"

#include "experiments/report/report_points.h"
#include "metrics/metric.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace {

using nlohmann::json;

/// Three significant digits, as a reader compares them.
std::string shown(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

/// Two, of a ratio; three near 1, where two would hide on which side it lies.
std::string shown_ratio(double ratio) {
    char text[32];
    std::snprintf(text, sizeof text, std::abs(ratio - 1) < 0.1 ? "%.3g" : ratio < 9.95 ? "%.2g" : "%.0f", ratio);
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
    return name_of(p) + ", " + shown(p.value) + interval_text(p.low, p.high);
}

std::string listed(const std::vector<AnswerPoint>& points, size_t most) {
    std::string text;
    for (size_t i = 0; i < std::min(points.size(), most); ++i)
        text += (i == 0 ? "" : i + 1 == points.size() ? " and " : ", ") + name_of(points[i]);
    if (points.size() > most) text += " and " + std::to_string(points.size() - most) + " more";
    return text;
}

/// What one shot's points scored, and how long they took.
struct Scored {
    AnswerPoint point;
    bool is_ranked = false;
    const TimeSummary* time = nullptr;  ///< of all its stages; null: not timed
};

/// The interval of a / b by the ends of both: wider than one of pairs would be, and so on the safe side.
struct Ratio {
    double value;
    std::optional<double> low, high;
};
Ratio ratio_of(double a, std::optional<double> a_low, std::optional<double> a_high, double b,
               std::optional<double> b_low, std::optional<double> b_high) {
    Ratio r{a / b, {}, {}};
    if (a_low && b_high && *b_high > 0) r.low = std::max(*a_low, 0.0) / *b_high;
    if (a_high && b_low && *b_low > 0) r.high = *a_high / *b_low;
    return r;
}
std::string shown(const Ratio& r) {
    return shown_ratio(r.value) +
           (r.low && r.high ? " [" + shown_ratio(*r.low) + ", " + shown_ratio(*r.high) + "]" : "");
}

PointSet oracles(const json& manifest) {
    PointSet points;
    for (const json& v : manifest.value("variants", json::array()))
        if (v.is_object() && v.value("asks_scene", false))
            points.insert({v.value("variant", ""), v.value("point", "")});
    return points;
}

using PointLabels = std::map<std::pair<std::string, std::string>, std::string>;

PointLabels point_labels(const json& manifest) {
    PointLabels labels;
    for (const json& v : manifest.value("variants", json::array()))
        if (v.is_object() && v.contains("label") && v["label"].is_string())
            labels[{v.value("variant", ""), v.value("point", "")}] = v["label"];
    return labels;
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
        if (s.time && s.is_ranked) timed.push_back(&s);
    std::ranges::stable_sort(timed, {}, [](const Scored* s) { return s->time->median; });
    std::vector<AnswerPoint> front;
    for (const Scored* s : timed)
        if (front.empty() || s->point.value < front.back().value) front.push_back(s->point);
    return front;
}

const Scored& find(const std::vector<Scored>& scored, const AnswerPoint& point) {
    return *std::ranges::find_if(
        scored, [&](const Scored& s) { return s.point.variant == point.variant && s.point.point == point.point; });
}

/// What a reader must know before a time is believed.
struct ClockRecord {
    double floor = 0;        ///< by which two copies of the same point differed: smaller differences say nothing
    bool is_proven = false;  ///< the clock that timed the shot proved itself
};
ClockRecord clock_of(const json& manifest, const std::string& shot) {
    const json clock = manifest.value("clock", json::object());
    ClockRecord found;
    if (clock.contains("aa_floor") && clock["aa_floor"].is_number()) found.floor = clock["aa_floor"];
    for (const json& proof : clock.value("proofs", json::array()))
        if (std::ranges::count(proof.value("shots", json::array()), json(shot)) > 0)
            found.is_proven = proof.value("verdict", "") == "passed";
    return found;
}

/// "; Y takes 0.6x its time at 1.8x the error": of the front's cheaper points, the one with the least error among those
/// that save a fifth of the time or more, and more than copies of the same point differ by.
std::string cheaper_clause(const ShotAnswer& answer, const std::vector<Scored>& scored, const ClockRecord& clock) {
    const double worth_while = std::min(0.8, 1 - clock.floor);
    const TimeSummary* own = find(scored, *answer.best).time;
    if (!own || !(own->median > 0)) return "";
    for (auto p = answer.front.rbegin(); p != answer.front.rend(); ++p) {
        const TimeSummary* time = find(scored, *p).time;
        if (time->median > worth_while * own->median || !(answer.best->value > 0)) continue;
        const Ratio times = ratio_of(time->median, time->low, time->high, own->median, own->low, own->high),
                    errors =
                        ratio_of(p->value, p->low, p->high, answer.best->value, answer.best->low, answer.best->high);
        return "; " + name_of(*p) + " takes " + shown(times) + " its time" +
               (clock.is_proven ? "" : " (by a clock that did not prove itself)") + " at " + shown(errors) +
               " the error";
    }
    return "; nothing on the front is faster by a fifth, or by more than copies of one point differ";
}

std::string limit_clause(const ShotAnswer& answer) {
    if (!answer.limit) return "";
    if (answer.limit->low.value_or(answer.limit->value) <= 0)  // noise can leave it below
        return "; what this one frame shows leaves no error that can be told from 0";
    const std::string limit = shown(answer.limit->value) + interval_text(answer.limit->low, answer.limit->high);
    const double least = answer.best->low.value_or(answer.best->value),
                 most = answer.limit->high.value_or(answer.limit->value);
    return least > most ? "; " + limit + " is left by one that finds all that this one frame shows"
                        : "; that is no more than the " + limit +
                              " that a technique leaves which finds all that this one frame shows";
}

std::string gain_clause(const ShotAnswer& answer) {
    if (!answer.baseline || answer.baseline->variant == answer.best->variant || !(answer.baseline->value > 0))
        return "";
    return " (" + shown_ratio(answer.best->value / answer.baseline->value) + " that of none)";
}

std::string sentence_of(const ShotAnswer& answer, const std::vector<Scored>& scored, const Headline& headline,
                        const ClockRecord& clock) {
    if (!answer.best)
        return "No " + headline.metric + " of this shot has an interval that holds all noise: nothing is ranked.";
    std::string text;
    if (answer.tied.empty())
        text = name_of(*answer.best) + " has the least error, " + headline.metric + " " + shown(answer.best->value) +
               interval_text(answer.best->low, answer.best->high) + gain_clause(answer);
    else
        text = name_of(*answer.best) + " has the least error measured, " + headline.metric + " " +
               shown(answer.best->value) + interval_text(answer.best->low, answer.best->high) + gain_clause(answer) +
               ", but cannot be told from " + listed(answer.tied, 3);
    return text + cheaper_clause(answer, scored, clock) + limit_clause(answer) + ".";
}

/// Distance from perfect.
double badness(const std::string& metric, double value) {
    return metric_named(metric).better == Better::lower ? value : -value;
}

std::string perceptual_sentence_of(const ShotAnswer& answer, const std::vector<AnswerPoint>& perceived,
                                   const std::string& metric, const std::optional<double>& floor) {
    if (perceived.empty() || !answer.best) return "";
    const auto of = [&](const AnswerPoint& p) {
        return std::ranges::find_if(perceived,
                                    [&](const AnswerPoint& q) { return q.variant == p.variant && q.point == p.point; });
    };
    const auto first =
        std::ranges::min_element(perceived, {}, [&](const AnswerPoint& p) { return badness(metric, p.value); });
    const std::string noise =
        floor ? " (of which the reference's own noise scores " + shown(*floor) + ")" : std::string();
    const auto own = of(*answer.best);
    if (own == perceived.end()) return "";
    if (own == first)
        return "By " + metric + ", which is nearer to what people see, it leads, too: " + shown(own->value) +
               interval_text(own->low, own->high) + noise + ".";
    // Where the noise of one is not known, no difference counts that noise alone would score.
    const bool have_intervals = own->low && own->high && first->low && first->high;
    const bool is_told = have_intervals ? std::max(*own->low, *first->low) > std::min(*own->high, *first->high)
                                        : floor && badness(metric, own->value) - badness(metric, first->value) > *floor;
    return "By " + metric + ", which is nearer to what people see, " + with_value(*first) + ", " +
           (is_told ? "is ahead of it" : "cannot be told from it") + " at " + shown(own->value) +
           interval_text(own->low, own->high) + noise + ".";
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
    const PointSet left_out = oracles(manifest);
    PointLabels labels = point_labels(manifest);
    std::vector<std::string> shots;
    for (const MetricSummary& e : tables.errors)
        if (std::ranges::count(shots, e.shot) == 0) shots.push_back(e.shot);
    std::vector<ShotAnswer> answers;
    for (const std::string& shot : shots) {
        ShotAnswer answer{.shot = shot, .limit = limit_of(manifest, shot, headline)};
        std::vector<Scored> scored;
        std::vector<AnswerPoint> perceived;
        std::optional<double> perceptual_floor;
        for (const MetricSummary& e : tables.errors) {
            if (!e.speaks_for_shot || e.shot != shot || e.mask != headline.mask || e.target != headline.target ||
                !e.value || left_out.contains({e.variant, e.point}))
                continue;
            const AnswerPoint point{e.variant, e.point, *e.value, e.low, e.high, labels[{e.variant, e.point}]};
            if (e.metric == headline.metric) {
                const auto time = std::ranges::find_if(tables.times, [&](const TimeSummary& t) {
                    return t.shot == shot && t.variant == e.variant && t.point == e.point && t.stage == "total";
                });
                scored.push_back({point, e.holds_all_noise, time == tables.times.end() ? nullptr : &*time});
                if (e.variant == "none" && !answer.baseline) answer.baseline = point;
            }
            if (e.metric == headline.perceptual_metric) perceived.push_back(point), perceptual_floor = e.floor;
        }
        if (scored.empty()) continue;
        for (const Scored& s : scored)
            if (s.is_ranked && (!answer.best || s.point.value < answer.best->value)) answer.best = s.point;
        for (const Scored& s : scored) {
            const AnswerPoint& p = s.point;
            if (!answer.best || !s.is_ranked || (p.variant == answer.best->variant && p.point == answer.best->point))
                continue;
            if (p.low.value_or(p.value) <= answer.best->high.value_or(answer.best->value)) answer.tied.push_back(p);
        }
        answer.front = front_of(scored);
        const ClockRecord clock = clock_of(manifest, shot);
        answer.is_clock_proven = clock.is_proven;
        answer.sentence = sentence_of(answer, scored, headline, clock);
        answer.perceptual_sentence =
            perceptual_sentence_of(answer, perceived, headline.perceptual_metric, perceptual_floor);
        answers.push_back(std::move(answer));
    }
    return answers;
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
        json tied = json::array(), front = json::array();
        for (const AnswerPoint& p : a.tied) tied.push_back(point_json(p));
        for (const AnswerPoint& p : a.front) front.push_back(point_json(p));
        list.push_back({{"shot", a.shot},
                        {"sentence", a.sentence},
                        {"perceptual_sentence", a.perceptual_sentence},
                        {"metric", headline.metric},
                        {"mask", headline.mask},
                        {"target", headline.target},
                        {"perceptual_metric", headline.perceptual_metric},
                        {"best", optional_json(a.best)},
                        {"tied", tied},
                        {"baseline", optional_json(a.baseline)},
                        {"limit", optional_json(a.limit)},
                        {"is_clock_proven", a.is_clock_proven},
                        {"front", front}});
    }
    return list;
}
