#include "experiments/results/answers/answers.h"

#include "core/number_text.h"
#include "experiments/results/answers/answer_text.h"
#include "experiments/results/answers/cause_and_cure.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/verdicts/interval.h"
#include "experiments/results/verdicts/power.h"
#include "experiments/results/verdicts/standings.h"
#include "experiments/results/verdicts/study_points.h"
#include "metrics/direction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace {

using nlohmann::json;

std::string with_value(const AnswerPoint& p) {
    return name_of(p) + " (" + shown(p.value) + interval_text(p.low, p.high) + ")";
}

/// " Certainly within 5 % of this error: B and C. It is undecided whether A errs less than D. The other 7 points
/// certainly have larger errors."
std::string others_text(const ShotAnswer& answer, const Headline& headline) {
    constexpr size_t most_named = 3;
    std::string text;
    if (!answer.near.empty())
        text += " Certainly within " + percent_text(headline.margin) +
                " of this error: " + listed(answer.near, most_named) + ".";
    if (!answer.tied.empty())
        text += " It is undecided whether " + name_of(*answer.best) + " errs less than " +
                listed(answer.tied, most_named) + ".";
    if (text.empty() || answer.behind.empty()) return text;
    return text + (answer.behind.size() == 1 ? " " + name_of(answer.behind.front()) + " certainly has a larger error."
                                             : " The other " + std::to_string(answer.behind.size()) +
                                                   " points certainly have larger errors.");
}

/// What one shot's points scored, and how long they took.
struct Scored {
    AnswerPoint point;
    const MetricSummary* error = nullptr;
    const TimeSummary* time = nullptr;  ///< of all its stages; null: not timed
    bool is_ranked() const { return error->ranked && error->low && error->high; }
};

bool is_same(const AnswerPoint& a, const AnswerPoint& b) { return a.technique == b.technique && a.point == b.point; }

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
std::optional<AnswerPoint> limit_of(const json& manifest, const std::string& shot, const Headline& headline) {
    for (const Rung& rung : truth_ladder(manifest, shot, {headline.metric, headline.mask, headline.target}))
        if (rung.name == "on_screen") return AnswerPoint{"truth ladder", rung.name, rung.value, rung.low, rung.high};
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

/// " Y takes 0.6x the time of X and has 1.8x the error of X.": of the front's cheaper points, the one with the least
/// error among those that save a fifth of the time or more, and more than copies of the same point differ by.
std::string cheaper_sentence(const ShotAnswer& answer, const std::vector<Scored>& scored, const ClockRecord& clock) {
    const double worth_while = std::min(0.8, 1 - clock.floor);
    const TimeSummary* own = find(scored, *answer.best).time;
    if (!own || !(own->median > 0)) return "";
    for (auto p = answer.front.rbegin(); p != answer.front.rend(); ++p) {
        const TimeSummary* time = find(scored, *p).time;
        if (time->median > worth_while * own->median || !(answer.best->value > 0)) continue;
        const std::string best = name_of(*answer.best);
        return " " + name_of(*p) + " takes " + shown(ratio_of(*time, *own)) + " the time of " + best +
               (clock.is_proven ? "" : " (timer not validated)") + " and has " +
               shown(over_best(find(scored, *p), *answer.best)) + " the error of " + best + ".";
    }
    if (!(worth_while > 0)) return " Times of copies of one point differ too much here to name a cheaper point.";
    return " No point on the front saves " + percent_text(1 - worth_while) + " of this time.";
}

std::string limit_sentence(const ShotAnswer& answer) {
    if (!answer.limit) return "";
    const std::string what = " lower bound for any single-frame technique";
    if (answer.limit->low.value_or(answer.limit->value) <= 0)  // noise can leave it below
        return " The" + what + " is not distinguishable from 0.";
    const std::string limit = shown(answer.limit->value) + interval_text(answer.limit->low, answer.limit->high);
    const double least = answer.best->low.value_or(answer.best->value),
                 most = answer.limit->high.value_or(answer.limit->value);
    return least > most ? " The" + what + " is " + limit + "." : " This error reaches the" + what + ", " + limit + ".";
}

std::string gain_clause(const ShotAnswer& answer, const std::vector<Scored>& scored) {
    if (!answer.baseline || answer.baseline->technique == answer.best->technique || !(answer.baseline->value > 0))
        return "";
    return ", " + shown(inverse(over_best(find(scored, *answer.baseline), *answer.best))) +
           " the error without reflections (none)";
}

/// "1 seed", of "none: 1 seed".
std::string why_not_ranked(const MetricSummary& e) {
    const std::string none = "none: ";
    if (e.interval.starts_with(none)) return e.interval.substr(none.size());
    return "not repeatable";
}

/// What was measured and is not ranked: said before the verdict where it measures less than the best of those that are.
std::string unranked_text(const ShotAnswer& answer, const std::vector<Scored>& scored, const Headline& headline) {
    if (answer.unranked.empty()) return "";
    const AnswerPoint& least = answer.unranked.front();
    const std::string why = " (" + why_not_ranked(*find(scored, least).error) + ")";
    const std::string measured =
        name_of(least) + " measures the least error, " + headline.metric + " " + shown(least.value);
    const std::string points =
        std::to_string(answer.unranked.size()) + " of " + std::to_string(scored.size()) + " points";
    if (!answer.best)
        return "Nothing is ranked: no " + headline.metric + " of this shot has an interval that holds all noise" + why +
               ". " + measured + ".";
    if (least.value < answer.best->value)
        return measured + ", but has no rank. " + points + " have no rank" + why + ". ";
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
    if (answer.unranked.size() + 1 == scored.size()) return text + name + " is the only ranked point" + value + ".";
    if (!text.empty()) text += "Among the ranked points, ";
    const bool is_certain = find(scored, *answer.best).error->standing == standing::best;
    text += name + (is_certain ? " has the least error" : " measures the least error") + value + ".";
    return text + others_text(answer, headline) + cheaper_sentence(answer, scored, clock) + limit_sentence(answer);
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
    const std::string by = "By " + metric + ", which is closer to what people see, ", name = name_of(own->point),
                      own_value = shown(own->point.value) + interval_text(own->point.low, own->point.high);
    if (perceived.size() == 1) return by + name + " has " + own_value + ".";
    if (own->error->standing == standing::best) return by + name + " is the best, too: " + own_value + ".";
    if (own == first)
        return by + name + " measures best, too: " + own_value + "." +
               (own->error->standing.empty() ? "" : " Its lead over other points is undecided.");
    const std::string is_better = with_value(first->point), than_own = " than " + with_value(own->point);
    if (own->error->standing == standing::behind)
        return by + is_better + " is significantly better" + than_own + " in a paired comparison.";
    const bool are_ranked = !own->error->standing.empty() && !first->error->standing.empty();
    return by + is_better + " measures better" + than_own +
           (are_ranked ? ", but the difference is undecided." : ", but not both points are ranked.");
}

/// The rows that judge each shot, by all metrics; shots and rows in the order of the results.
std::vector<std::pair<std::string, std::vector<const MetricSummary*>>> judged_by_shot(const StudyResults& tables,
                                                                                      const Headline& headline) {
    const PointSet left_out = points_using_scene_data(tables.manifest);
    std::vector<std::pair<std::string, std::vector<const MetricSummary*>>> shots;
    std::map<std::string, size_t> places;
    for (const MetricSummary& e : tables.summary) {
        const auto [place, is_new] = places.try_emplace(e.shot, shots.size());
        if (is_new) shots.push_back({e.shot, {}});
        if (e.represents_shot && e.mask == headline.mask && e.target == headline.target && e.value &&
            !left_out.contains({e.technique, e.point}))
            shots[place->second].second.push_back(&e);
    }
    return shots;
}

}  // namespace

Headline headline_of(const json& manifest, std::span<const MetricSummary> errors) {
    const PrimaryComparisons primary = primary_of(manifest);
    Headline headline{primary.metric, primary.mask, primary.target, "", primary.margin};
    for (const char* name : {"flip", "ssim"})
        if (headline.perceptual_metric.empty() && name != headline.metric &&
            std::ranges::any_of(errors, [&](const MetricSummary& e) { return e.metric == name; }))
            headline.perceptual_metric = name;
    return headline;
}

std::vector<ShotAnswer> shot_answers(const StudyResults& tables) {
    const json& manifest = tables.manifest;
    const Headline headline = headline_of(manifest, tables.summary);
    auto labels = point_labels(manifest);
    const size_t comparisons = comparisons_left(tables.summary, headline.target, headline.metric, headline.mask);
    std::map<std::array<std::string, 3>, const TimeSummary*> totals;  // by shot, technique and point
    for (const TimeSummary& t : tables.time_summary)
        if (t.stage == "total") totals.try_emplace({t.shot, t.technique, t.point}, &t);
    std::vector<ShotAnswer> answers;
    for (const auto& [shot, judged] : judged_by_shot(tables, headline)) {
        ShotAnswer answer{.shot = shot, .limit = limit_of(manifest, shot, headline)};
        std::vector<Scored> scored, perceived;
        for (const MetricSummary* row : judged) {
            const MetricSummary& e = *row;
            const AnswerPoint point{e.technique, e.point, *e.value, e.low, e.high, labels[{e.technique, e.point}]};
            if (e.metric == headline.metric) {
                const auto time = totals.find({shot, e.technique, e.point});
                scored.push_back({point, &e, time == totals.end() ? nullptr : time->second});
                if (e.technique == "none" && !answer.baseline) answer.baseline = point;
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
            else if (s.error->p_equivalent.value_or(1) < significance)
                answer.near.push_back(s.point);
            else if (s.error->standing == standing::behind)
                answer.behind.push_back(s.point);
            else if (s.error->standing == standing::tied)
                answer.tied.push_back(s.point);
        }
        answer.front = front_of(scored);
        const ClockRecord clock{aa_floor(manifest, shot).value_or(0), is_clock_proven(manifest, shot)};
        answer.is_clock_proven = clock.is_proven;
        const JudgedShot of_shot{judged, headline.metric, shot_entry(manifest, shot).value("reference", json()), labels,
                                 comparisons};
        answer.sentence =
            sentence_of(answer, scored, headline, clock) + cure_sentences(of_shot) + power_sentence(of_shot);
        answer.perceptual_sentence = perceptual_sentence_of(answer, perceived, headline.perceptual_metric);
        answers.push_back(std::move(answer));
    }
    return answers;
}

json answers_json(const std::vector<ShotAnswer>& answers, const Headline& headline) {
    const auto point_json = [](const AnswerPoint& p) {
        return json{{"technique", p.technique},
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
                        {"near", points_json(a.near)},
                        {"tied", points_json(a.tied)},
                        {"unranked", points_json(a.unranked)},
                        {"baseline", optional_json(a.baseline)},
                        {"limit", optional_json(a.limit)},
                        {"is_clock_proven", a.is_clock_proven},
                        {"front", points_json(a.front)}});
    }
    return list;
}
