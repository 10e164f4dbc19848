#include "experiments/results/verdicts/summary.h"

#include "core/error.h"
#include "experiments/results/cells/study_rows.h"
#include "experiments/results/verdicts/interval.h"
#include "metrics/direction.h"
#include "metrics/statistics/median_interval.h"
#include "metrics/statistics/quantiles.h"
#include "metrics/temporal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace {

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / double(values.size());
}

double standard_deviation(const std::vector<double>& values) {
    const double m = mean(values);
    double sum = 0;
    for (const double v : values) sum += (v - m) * (v - m);
    return std::sqrt(sum / double(values.size() - 1));
}

/// The values of all rows, or none if one row has none.
std::optional<std::vector<double>> values_of(const std::vector<const ResultRow*>& rows,
                                             std::optional<double> ResultRow::*member) {
    std::vector<double> values;
    for (const ResultRow* row : rows) {
        if (!(row->*member)) return {};
        values.push_back(*(row->*member));
    }
    return values;
}

/// Whether a row's interval is open to one side: the length of a ghost that may never end has no upper end.
bool is_one_sided(const ResultRow* row) { return row->low.has_value() != row->high.has_value(); }

/// Flicker and lengths are of the pixels of one sequence: their rows' intervals are those of the choice of pixels.
bool is_of_pixels(const std::string& metric) {
    const TemporalMetric* const temporal = find_temporal_metric(metric);
    return temporal && !temporal->is_of_truth;
}

/// Whether the interval of a row comes from the noise of its pixels, which it lacks only where that is not trusted
/// (noise_half_width()).
bool is_freed_of_noise(const MetricSummary& s) {
    return s.corrected || s.metric == "bias" || s.metric == "energy_ratio";
}

void set_interval(MetricSummary& s, const std::vector<const ResultRow*>& rows, bool depends_on_seed) {
    const auto lows = values_of(rows, &ResultRow::low), highs = values_of(rows, &ResultRow::high);
    // Half A against half B: no error at all means no noise, but where outliers are counted or left out.
    const bool has_rows = lows && highs, passes_over_outliers = s.metric == "outliers" || s.metric == "relmse_trimmed",
               reference_is_exact = s.floor == 0.0 && !passes_over_outliers;
    s.interval = depends_on_seed && s.seeds < 2            ? interval::one_seed
                 : std::ranges::any_of(rows, is_one_sided) ? interval::open_end
                 : depends_on_seed && has_rows
                     ? (is_of_pixels(s.metric) ? interval::pixels_and_seeds : interval::reference_and_seeds)
                 : has_rows && is_of_pixels(s.metric)    ? interval::pixels
                 : has_rows                              ? interval::reference
                 : reference_is_exact && depends_on_seed ? interval::seeds
                 : reference_is_exact                    ? interval::reference
                 : is_of_pixels(s.metric)                ? interval::one_tile
                 : is_freed_of_noise(s)                  ? interval::few_paths
                                                         : interval::unknown_reference;
    if (std::string_view(s.interval).starts_with("none")) return;
    s.ranked = true;
    const double from_seeds = depends_on_seed ? student_t_quantile(0.975, double(s.seeds - 1)) * *s.seed_deviation /
                                                    std::sqrt(double(s.seeds))
                                              : 0.0;
    const auto lit_half_widths = values_of(rows, &ResultRow::lit_half_width);
    const double from_light = lit_half_widths ? mean(*lit_half_widths) : 0.0;
    s.low = *s.value - std::hypot(from_seeds, has_rows ? *s.value - mean(*lows) : 0.0, from_light) -
            s.lit_noise.value_or(0.0);
    s.high = *s.value + std::hypot(from_seeds, has_rows ? mean(*highs) - *s.value : 0.0, from_light);
    // Corrected for the reference's noise an error may come out below 0 itself; no interval leaves its value out.
    if (is_error(s.metric)) s.low = std::max(*s.low, std::min(0.0, *s.value));
    s.high = std::min(*s.high, greatest_value(s.metric));
}

MetricSummary summary_of(const std::vector<const ResultRow*>& rows, bool depends_on_seed) {
    const ResultRow& first = *rows.front();
    MetricSummary s{first.shot,   first.frame,  first.technique, first.point,
                    first.target, first.metric, first.formula,   first.mask};
    s.seeds = unsigned(rows.size());
    s.corrected = first.corrected, s.represents_shot = first.represents_shot;
    for (const ResultRow* row : rows) {
        s.pixels = std::max(s.pixels, row->pixels);
        s.non_finite = std::max(s.non_finite, row->non_finite);
        s.negative = std::max(s.negative, row->negative);
    }
    if (const auto floors = values_of(rows, &ResultRow::floor)) s.floor = mean(*floors);
    if (const auto lit = values_of(rows, &ResultRow::lit_noise)) s.lit_noise = mean(*lit);
    const auto values = values_of(rows, &ResultRow::value);
    s.interval = interval::no_value;
    if (!values) return s;
    s.value = mean(*values);
    if (s.seeds > 1) s.seed_deviation = standard_deviation(*values);
    set_interval(s, rows, depends_on_seed);
    return s;
}

/// Rows of equal keys together, groups in the order in which they first appear.
template <class Row, class KeyOf>
std::vector<std::vector<const Row*>> grouped(std::span<const Row> rows, KeyOf key_of) {
    std::map<decltype(key_of(rows[0])), size_t> index;
    std::vector<std::vector<const Row*>> groups;
    for (const Row& row : rows) {
        const auto [at, is_new] = index.emplace(key_of(row), groups.size());
        if (is_new) groups.emplace_back();
        groups[at->second].push_back(&row);
    }
    return groups;
}

}  // namespace

unsigned MetricSummary::seed_degrees() const {
    return interval.find("seeds") != std::string::npos && seeds > 1 ? seeds - 1 : 0;
}

Extrapolated MetricSummary::extrapolated() const {
    return {*value, value_of_power.value_or(*value), value_of_bounded.value_or(*value)};
}

bool MetricSummary::counts_over_scenes() const {
    const bool has_known_bias = corrected || floor == 0.0 || value_of_power;
    const bool is_one_draw = interval == interval::one_seed || interval == interval::few_paths;
    return value && ((ranked && low) || (is_one_draw && has_known_bias));
}

std::vector<MetricSummary> summarise(std::span<const ResultRow> rows, const PointSet& without_seeds,
                                     std::span<const ReferenceNoise> noise) {
    using Error = std::tuple<std::string, std::string, std::string, std::string, std::string, std::string, std::string>;
    std::map<Error, Extrapolated> without_noise;
    for (const ReferenceNoise& n : noise)
        if (const auto mean = extrapolated_mean(n.growth))
            without_noise[{n.shot, n.frame, n.technique, n.point, n.target, n.metric, n.mask}] = *mean;
    std::vector<MetricSummary> summaries;
    const auto key = [](const ResultRow& r) {
        return std::tie(r.shot, r.frame, r.technique, r.point, r.target, r.metric, r.formula, r.mask);
    };
    for (const auto& group : grouped(rows, key)) {
        const ResultRow& first = *group.front();
        MetricSummary& s =
            summaries.emplace_back(summary_of(group, !without_seeds.contains({first.technique, first.point})));
        const auto found = without_noise.find({s.shot, s.frame, s.technique, s.point, s.target, s.metric, s.mask});
        if (found != without_noise.end())
            s.value_of_power = found->second.of_power, s.value_of_bounded = found->second.of_bounded;
    }
    return summaries;
}

std::vector<TimeSummary> summarise(std::span<const TimeRow> rows, const std::map<std::string, double>& floors) {
    std::vector<TimeSummary> summaries;
    const auto key = [](const TimeRow& t) { return std::tie(t.shot, t.technique, t.point, t.stage); };
    for (const auto& group : grouped(rows, key)) {
        std::map<std::pair<unsigned, unsigned>, double> of_frame;  // a stage may run several times in a frame
        for (const TimeRow* row : group) of_frame[{row->seed, row->frame}] += row->milliseconds;
        std::vector<double> times;
        for (const auto& [frame, milliseconds] : of_frame) times.push_back(milliseconds);
        const auto disturbed = std::ranges::count_if(group, [](const TimeRow* row) { return row->disturbed; });
        const TimeRow& first = *group.front();
        const Estimate m = median_interval(times);
        const auto floor = floors.find(first.shot);
        const double near = 1 + (floor == floors.end() ? 0.0 : floor->second);
        summaries.push_back({first.shot, first.technique, first.point, first.stage, first.clock, times.size(), m.value,
                             m.low, m.high, std::max(m.high, m.value * near), std::min(m.low, m.value / near),
                             double(disturbed) / double(group.size())});
    }
    return summaries;
}
