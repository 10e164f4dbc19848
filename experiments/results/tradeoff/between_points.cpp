#include "experiments/results/tradeoff/between_points.h"

#include <zlib.h>

#include <algorithm>
#include <cstdio>

namespace {

using nlohmann::json;

bool is_of_error(const auto& row, const PrimaryComparisons& error) {
    return row.target == error.target && row.metric == error.metric && row.mask == error.mask;
}

/// Of the last frame alone: none where the errors stand for all frames of the shot.
std::vector<Rung> ladder_of(const StudyResults& tables, const std::string& shot, const PrimaryComparisons& error) {
    for (const MetricSummary& e : tables.summary)
        if (e.represents_shot && e.shot == shot && is_of_error(e, error) && e.frame.empty()) return {};
    return truth_ladder(tables.manifest, shot, error);
}

std::unique_ptr<MeasuredShot> measured_shot(const StudyResults& tables, const PrimaryComparisons& error,
                                            const Tradeoff& found, const FrontRow& first) {
    auto shot = std::make_unique<MeasuredShot>();
    shot->name = first.shot, shot->scene = first.scene, shot->machine = first.machine;
    const std::string label = shot_entry(tables.manifest, first.shot).value("label", "");
    shot->label = label.empty() ? first.shot : label;
    shot->divisor = std::ranges::find(found.divisors, first.shot, [](const auto& d) { return d.first; })->second;
    if (found.kind == CostKind::timed) {
        shot->floor = aa_floor(tables.manifest, first.shot).value_or(shot->floor);
        shot->is_clock_proven = is_clock_proven(tables.manifest, first.shot);
    }
    shot->ladder = ladder_of(tables, first.shot, error);
    for (const FrontRow& row : found.front) {
        if (row.shot != first.shot) continue;
        MeasuredPoint& p = shot->points.emplace_back(MeasuredPoint{.row = row, .seeds = {}, .rounds = {}});
        const auto is_of_point = [&](const auto& other) {
            return other.shot == row.shot && other.technique == row.technique && other.point == row.point;
        };
        for (const ResultRow& r : tables.results)
            if (r.represents_shot && r.value && is_of_point(r) && is_of_error(r, error))
                p.seeds.emplace_back(r.seed, *r.value);
        if (found.kind != CostKind::timed) continue;
        // Several seeds may have been timed: each of their frames is a round of its own.
        for (const TimeRow& t : tables.times)
            if (t.stage == "total" && is_of_point(t)) p.rounds[{t.seed, t.frame}] = t.milliseconds;
        for (const TimeSummary& t : tables.time_summary)
            if (t.stage == "total" && is_of_point(t)) p.disturbed_share = t.disturbed_share;
    }
    std::vector<const MeasuredPoint*> judged;
    std::vector<std::pair<std::string, std::vector<size_t>>> techniques;
    for (const MeasuredPoint& p : shot->points) {
        if (!p.is_judged()) continue;
        auto own = std::ranges::find(techniques, p.row.technique, [](const auto& v) { return v.first; });
        if (own == techniques.end()) own = techniques.insert(own, {p.row.technique, {}});
        own->second.push_back(judged.size());
        judged.push_back(&p);
    }
    if (judged.empty()) return shot;
    // The same deviates whenever a shot is asked about; other ones in each shot.
    const auto* name = reinterpret_cast<const Bytef*>(shot->name.data());
    const Draws draws = draws_of(judged, unsigned(crc32(0, name, uInt(shot->name.size()))));
    for (const auto& [technique, rows] : techniques) {
        std::vector<const MeasuredPoint*> own;
        for (const size_t row : rows) own.push_back(judged[row]);
        shot->curves.emplace_back(technique, Curve(std::move(own), draws, rows));
    }
    return shot;
}

template <class Row>
Row row_of(const MeasuredShot& shot, const std::string& unit) {
    Row row{};
    row.shot = shot.name, row.scene = shot.scene, row.machine = shot.machine, row.unit = unit;
    return row;
}

template <class Row>
Row curve_row(const MeasuredShot& shot, const std::string& unit, const std::string& technique, const Curve& curve) {
    Row row = row_of<Row>(shot, unit);
    row.technique = row.label = technique, row.start = curve.start(), row.end = curve.end();
    return row;
}

void add_errors_at(const MeasuredShot& shot, const Tradeoff& found, std::span<const double> costs,
                   std::vector<ErrorAtCostRow>& rows) {
    for (const auto& [technique, curve] : shot.curves)
        for (const double cost : costs) {
            ErrorAtCostRow& row = rows.emplace_back(curve_row<ErrorAtCostRow>(shot, found.unit, technique, curve));
            const auto chosen = std::ranges::find_if(found.chosen, [&](const ChosenPoint& c) {
                return c.shot == shot.name && c.technique == technique && c.cost == cost;
            });
            row.cost = cost, row.fits = chosen->fits, row.status = "before start";
            if (chosen->point.empty()) continue;
            const ReadOff read = curve.error_at(cost);
            const MeasuredPoint& p =
                *std::ranges::find(shot.points, PointName(technique, chosen->point), &MeasuredPoint::name);
            const bool is_at = std::ranges::count(curve.points(), cost, &MeasuredPoint::cost) > 0;
            row.status = is_at ? "at" : cost > curve.end() ? "past end" : "between";
            row.error = read.value, row.low = read.low, row.high = read.high;
            row.point = p.row.point, row.chosen_on = chosen->chosen_on;
            row.point_error = p.row.error, row.point_low = p.row.error_low, row.point_high = p.row.error_high;
        }
}

void add_costs_to(const MeasuredShot& shot, const Tradeoff& found, std::span<const double> factors,
                  std::vector<CostToErrorRow>& rows) {
    if (!shot.divisor) return;
    for (const auto& [technique, curve] : shot.curves)
        for (const double factor : factors) {
            CostToErrorRow& row = rows.emplace_back(curve_row<CostToErrorRow>(shot, found.unit, technique, curve));
            const double error = factor * *shot.divisor;
            const ReadOff read = curve.cost_to(error);
            row.factor = factor, row.error = error, row.share_that_reach = read.share, row.status = "not reached";
            if (!read.value) continue;
            row.status = error >= curve.start_error() ? "before start" : *read.value == curve.end() ? "at" : "between";
            row.cost = read.value, row.low = read.low, row.high = read.high;
        }
}

/// A rung, and a measured error over it by the ends of both: no upper end where the rung is not distinguishable from 0.
struct OverRung {
    std::string rung;
    NineDigits error, low, high, over, over_low, over_high;
};

OverRung over_rung(const MeasuredShot& shot, const std::string& name, const std::optional<double>& error,
                   const std::optional<double>& error_low, const std::optional<double>& error_high) {
    const auto& [rung, value, low, high] = *std::ranges::find(shot.ladder, name, &Rung::name);
    OverRung found{.rung = rung, .error = value, .low = low, .high = high, .over = {}, .over_low = {}, .over_high = {}};
    if (!error || !(value > 0)) return found;
    found.over = *error / value;
    if (error_low) found.over_low = *error_low / (high && *high != 0 ? *high : value);
    if (error_high && low && *low > 0) found.over_high = *error_high / *low;
    return found;
}

bool has_rung(const MeasuredShot& shot, const std::string& name) {
    return std::ranges::count(shot.ladder, name, &Rung::name) > 0;
}

void add_limits(const MeasuredShot& shot, const Tradeoff& found, std::vector<LimitRow>& rows) {
    const MeasuredPoint* least = nullptr;
    for (const MeasuredPoint& p : shot.points)
        if (p.is_ranked() && (!least || p.error() < least->error())) least = &p;
    for (const char* rung : rungs) {
        if (!least || !has_rung(shot, rung)) continue;
        const FrontRow& p = least->row;
        LimitRow& row = rows.emplace_back(row_of<LimitRow>(shot, found.unit));
        row.technique = p.technique, row.point = p.point, row.label = p.label, row.cost = p.cost;
        row.error = p.error, row.error_low = p.error_low, row.error_high = p.error_high;
        const OverRung over = over_rung(shot, rung, p.error, p.error_low, p.error_high);
        row.rung = over.rung, row.rung_error = over.error, row.rung_low = over.low, row.rung_high = over.high;
        row.over_rung = over.over, row.over_rung_low = over.over_low, row.over_rung_high = over.over_high;
    }
}

void add_fits(const MeasuredShot& shot, const Tradeoff& found, const std::map<PointName, json>& parameters,
              std::vector<FitRow>& rows) {
    const auto rung = std::ranges::find_if(rungs, [&](const char* name) { return has_rung(shot, name); });
    for (const QualityAxis& axis : quality_axes(shot.points, parameters)) {
        const auto [points, fit] = fit_axis(axis, shot.floor);
        FitRow& row = rows.emplace_back(row_of<FitRow>(shot, found.unit));
        row.technique = row.label = axis.technique, row.parameter = axis.parameter, row.fixed = axis.fixed;
        row.points = points.size(), row.status = fit.status;
        for (const MeasuredPoint* p : points) {
            row.point_names += (row.point_names.empty() ? "" : "; ") + p->row.point;
            row.cost_from = std::min(row.cost_from.value_or(p->cost()), p->cost());
            row.cost_to = std::max(row.cost_to.value_or(p->cost()), p->cost());
        }
        row.floor = fit.floor, row.floor_low = fit.floor_low, row.floor_high = fit.floor_high;
        row.a = fit.a, row.b = fit.b, row.b_low = fit.b_low, row.b_high = fit.b_high, row.misfit = fit.misfit;
        if (rung == rungs.end()) continue;
        const OverRung over = over_rung(shot, *rung, fit.floor, fit.floor_low, fit.floor_high);
        row.rung = over.rung, row.rung_error = over.error, row.rung_low = over.low, row.rung_high = over.high;
        row.floor_over_rung = over.over, row.floor_over_rung_low = over.over_low;
        row.floor_over_rung_high = over.over_high;
    }
}

}  // namespace

std::string csv_field(const NineDigits& value) {
    if (!value) return "";
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", *value);
    return text;
}

BetweenPoints between_points(const StudyResults& tables, const PrimaryComparisons& error, const Tradeoff& found,
                             std::span<const double> costs, std::span<const double> factors) {
    const std::map<PointName, json> parameters = parameters_of_points(tables.manifest);
    BetweenPoints between;
    for (const FrontRow& row : found.front)
        if (std::ranges::none_of(between.shots, [&](const auto& shot) { return shot->name == row.shot; }))
            between.shots.push_back(measured_shot(tables, error, found, row));
    for (const auto& shot : between.shots) {
        add_errors_at(*shot, found, costs, between.error_at_cost);
        add_costs_to(*shot, found, factors, between.cost_to_error);
        add_fits(*shot, found, parameters, between.fits);
        add_limits(*shot, found, between.limits);
    }
    return between;
}
