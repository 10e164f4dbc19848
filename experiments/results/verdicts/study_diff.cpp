#include "experiments/results/verdicts/study_diff.h"

#include "core/error.h"
#include "core/files.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/verdicts/interval.h"
#include "experiments/results/verdicts/standings.h"
#include "experiments/results/verdicts/study_points.h"
#include "metrics/statistics/estimates.h"
#include "metrics/statistics/quantiles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace {

using nlohmann::json;

constexpr double rounding = 1e-6;             // relative: other compilers add in another order
constexpr double most_disturbed_share = 0.5;  // of the frames that a time is the median of

using NameOfNumber =
    std::tuple<std::string, std::string, std::string, std::string, std::string, std::string, std::string>;
template <class Row>
NameOfNumber number_of(const Row& r) {
    return {r.shot, r.frame, r.technique, r.point, r.target, r.metric, r.mask};
}

/// One study's numbers by what they are of.
struct ComparedFolder {
    explicit ComparedFolder(const StudyResults& tables)
        : manifest(tables.manifest),
          not_repeatable(points_not_repeatable(manifest)),
          without_seeds(points_without_seeds(manifest)) {
        for (const MetricSummary& e : tables.summary)
            if (e.represents_shot) errors[number_of(e)] = &e, points.insert({e.shot, e.technique, e.point});
        for (const ResultRow& r : tables.results)
            if (r.represents_shot && r.value) values[number_of(r)][r.seed] = *r.value;
        for (const TimeSummary& t : tables.time_summary)
            if (t.stage == "total" && !t.technique.empty()) times[{t.shot, t.technique, t.point}] = &t;
    }

    const json& manifest;
    PointSet not_repeatable, without_seeds;
    std::map<NameOfNumber, const MetricSummary*> errors;
    std::map<NameOfNumber, std::map<unsigned, double>> values;  ///< by seed
    std::map<PointOfShot, const TimeSummary*> times;
    std::set<PointOfShot> points;
};

/// What the pixels of a shot's references are known by: how they were made, and what their noise came out as.
json truth_of(const json& manifest, const std::string& shot) {
    json found = json::array();
    for (const json& r : shot_entry(manifest, shot).value("references", json::array()))
        found.push_back({r.value("hash", ""), r.value("relative_error", json()), r.value("rays", json())});
    return found;
}

bool is_rounding(double a, double b) { return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b)); }

/// By the mean difference of the seeds; none where no seed differs but by rounding.
std::optional<PairP> paired_p(const std::map<unsigned, double>& before, const std::map<unsigned, double>& after,
                              double margin) {
    std::vector<double> differences;
    bool is_equal = true;
    double mean = 0, squares = 0, mean_before = 0;
    for (const auto& [seed, value] : before) {
        differences.push_back(after.at(seed) - value);
        mean += differences.back() / double(before.size()), mean_before += value / double(before.size());
        is_equal = is_equal && is_rounding(value, after.at(seed));
    }
    if (is_equal) return {};
    for (const double d : differences) squares += (d - mean) * (d - mean);
    const double n = double(differences.size()), error = std::sqrt(squares / (n - 1) / n);
    return PairP{error > 0 ? 2 * student_t_cdf(-std::abs(mean) / error, n - 1) : 0.0,
                 p_beyond_limits(mean, margin * std::abs(mean_before), error, n - 1)};
}

bool has_same_seeds(const std::map<unsigned, double>& a, const std::map<unsigned, double>& b) {
    return !a.empty() && std::ranges::equal(
                             a, b, {}, [](const auto& v) { return v.first; }, [](const auto& v) { return v.first; });
}

void settle(NumberChange& c, const char* verdict, std::string how) { c.verdict = verdict, c.how = std::move(how); }

/// Gives a verdict where chance has no part, else a p.
void compare_errors(NumberChange& c, const MetricSummary& a, const MetricSummary& b, const ComparedFolder& before,
                    const ComparedFolder& after, double margin) {
    const auto set = [&](const PairP& p, const char* how) {
        c.p = p.different, c.p_equivalent = p.beyond, c.how = how;
    };
    const auto is_in = [&](PointSet ComparedFolder::*set) {
        return (before.*set).contains({c.technique, c.point}) || (after.*set).contains({c.technique, c.point});
    };
    if (!a.value || !b.value) return settle(c, a.value || b.value ? change::not_judged : change::equal, "no value");
    if (*a.value == *b.value) return settle(c, change::equal, "");
    if (is_in(&ComparedFolder::not_repeatable)) return settle(c, change::not_judged, "not repeatable");
    const auto seeds_before = before.values.find(number_of(a)), seeds_after = after.values.find(number_of(b));
    const bool has_seeds = seeds_before != before.values.end() && seeds_after != after.values.end();
    if (has_seeds && has_same_seeds(seeds_before->second, seeds_after->second) &&
        truth_of(before.manifest, c.shot) == truth_of(after.manifest, c.shot)) {
        if (seeds_before->second.size() > 1 && !is_in(&ComparedFolder::without_seeds)) {
            const auto p = paired_p(seeds_before->second, seeds_after->second, margin);
            return p ? set(*p, "paired by seed") : settle(c, change::equal, "rounding");
        }
        return is_rounding(*a.value, *b.value) ? settle(c, change::equal, "rounding")
                                               : settle(c, change::changed, "same seed and truth");
    }
    if (is_rounding(*a.value, *b.value)) return settle(c, change::equal, "rounding");
    for (const MetricSummary* e : {&a, &b})
        if (!e->ranked || !e->low || !e->high)
            return settle(c, change::not_judged, e->interval.starts_with("none") ? e->interval : "not ranked");
    set(p_by_intervals(b, a, margin), "by intervals");
}

void compare_times(NumberChange& c, const TimeSummary& a, const TimeSummary& b, const json& before, const json& after) {
    if (std::max(a.disturbed_share, b.disturbed_share) >= most_disturbed_share)
        return settle(c, change::not_judged, "disturbed");
    const auto floor_before = aa_floor(before, c.shot), floor_after = aa_floor(after, c.shot);
    if (!floor_before || !floor_after) return settle(c, change::not_judged, "no point was timed twice");
    if (!(a.low > 0 && b.low > 0)) return settle(c, change::not_judged, "a time of 0");
    if (a.median == b.median) return settle(c, change::equal, "");
    const double of_intervals = std::hypot(std::log(a.high / a.low) / 2, std::log(b.high / b.low) / 2),
                 of_copies = std::hypot(std::log1p(*floor_before), std::log1p(*floor_after));
    const TimeRatio ratio{.log_ratio = std::log(b.median / a.median),
                          .half_width = std::hypot(of_intervals, of_copies),
                          .degrees = std::min(aa_pair_count(before, c.shot), aa_pair_count(after, c.shot))};
    if (!(ratio.half_width > 0)) return settle(c, change::changed, "times do not scatter");
    c.p = ratio.p_value(), c.how = "by intervals and copies";
}

/// The machine that took a shot's times, and its device.
std::string machine_of(const json& manifest, const std::string& shot) {
    std::set<std::string> hosts, devices;
    const auto add = [&](const json& host) {
        hosts.insert(host.value("name", "?") + " (" + host.value("cpu", "?") + ")");
    };
    for (const json& load : manifest.value("clock", json::object()).value("load", json::array()))
        if (load.value("shot", "") == shot && load.contains("host")) add(load["host"]);
    for (const json& maker : manifest.value("provenance", json::array())) {
        if (hosts.empty() && maker.contains("host")) add(maker["host"]);
        if (maker.contains("device")) devices.insert(maker["device"].value("name", "?"));
    }
    std::string text;
    for (const auto& names : {hosts, devices})
        for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

/// Decides those that have a p, all as one family.
void decide(const std::vector<NumberChange*>& family) {
    std::vector<double> different, beyond;
    for (const NumberChange* c : family) different.push_back(*c->p), beyond.push_back(c->p_equivalent.value_or(1));
    different = holm_adjusted(different), beyond = holm_adjusted(beyond);
    for (size_t i = 0; i < family.size(); ++i) {
        family[i]->p_holm = different[i];
        family[i]->verdict = different[i] < significance ? change::changed
                             : beyond[i] < significance  ? change::equivalent
                                                         : change::undecided;
    }
}

std::vector<PointOfShot> points_in_first(const ComparedFolder& first, const ComparedFolder& second) {
    std::vector<PointOfShot> found;
    std::ranges::set_difference(first.points, second.points, std::back_inserter(found));
    return found;
}

}  // namespace

double NumberChange::size() const {
    const double ratio = *after / *before;
    return ratio > 0 && std::isfinite(ratio) ? std::abs(std::log(ratio)) : HUGE_VAL;
}

StudyDiff diff_studies(const StudyResults& before_tables, const StudyResults& after_tables, bool judges_times,
                       double margin) {
    const ComparedFolder before(before_tables), after(after_tables);
    StudyDiff diff{.errors = {},
                   .times = {},
                   .moved = {},
                   .only_before = points_in_first(before, after),
                   .only_after = points_in_first(after, before)};
    for (const auto& [number, a] : before.errors)
        if (const auto b = after.errors.find(number); b != after.errors.end()) {
            NumberChange c{a->shot,   a->frame, a->technique, a->point,        a->target,
                           a->metric, a->mask,  a->value,     b->second->value};
            compare_errors(c, *a, *b->second, before, after, margin);
            diff.errors.push_back(c);
        }
    std::set<std::string> moved;
    for (const auto& [point, a] : before.times) {
        const auto b = after.times.find(point);
        if (b == after.times.end()) continue;
        const std::string machines[] = {machine_of(before.manifest, a->shot), machine_of(after.manifest, a->shot)};
        if (machines[0] != machines[1]) {
            if (moved.insert(a->shot).second) diff.moved.push_back({a->shot, machines[0], machines[1]});
            continue;
        }
        NumberChange c{a->shot, "", a->technique, a->point, "", "total_ms", "", a->median, b->second->median};
        compare_times(c, *a, *b->second, before.manifest, after.manifest);
        diff.times.push_back(c);
    }
    std::vector<NumberChange*> of_errors, of_times;
    for (NumberChange& c : diff.errors)
        if (c.p) of_errors.push_back(&c);
    for (NumberChange& c : diff.times)
        if (c.p) (judges_times ? of_errors : of_times).push_back(&c);
    decide(of_errors), decide(of_times);
    return diff;
}

size_t count_of(const std::vector<NumberChange>& changes, const std::string& verdict) {
    return size_t(std::ranges::count(changes, verdict, &NumberChange::verdict));
}
