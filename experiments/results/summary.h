#pragma once
#include "experiments/results/cell.h"
#include "experiments/results/effects.h"

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

/// results.csv, splits.csv, effects.csv and times.csv as they were written. Every mistake in them is an Error that
/// names file, line and column.
std::vector<ResultRow> read_result_rows(const std::filesystem::path& file);
std::vector<HitRow> read_hit_rows(const std::filesystem::path& file);
std::vector<SplitRow> read_split_rows(const std::filesystem::path& file);
std::vector<EffectRow> read_effect_rows(const std::filesystem::path& file);
std::vector<TimeRow> read_time_rows(const std::filesystem::path& file);

/// One metric of one variant point over all its seeds.
struct MetricSummary {
    std::string shot, frame, variant, point, target, metric, formula, mask;
    unsigned seeds = 0;
    std::optional<double> value;           ///< mean over the seeds; none if one of them has none
    std::optional<double> low, high;       ///< 95 % interval, see summarise()
    std::string interval = {};             ///< what it holds, or why there is none (interval.h)
    bool holds_all_noise = false;          ///< so that it can be told from those of other points: only such are ranked
    std::optional<double> seed_deviation;  ///< standard deviation over the seeds; none for a single one
    std::optional<double> floor;           ///< what the reference's own noise scores
    std::optional<double> lit_noise;       ///< what the noise of the lit colour adds to the value (LitNoise)
    bool is_corrected = false;
    size_t pixels = 0, non_finite = 0, negative = 0;  ///< the last two are the worst seed's
};

/// The interval of the mean over n seeds joins, in quadrature, what the reference's noise leaves (it is the same
/// reference for all seeds, so the mean of the rows' intervals) and Student's t interval of the seeds, t(0.975, n-1) s
/// / sqrt(n). Metrics whose rows have no interval, since what the reference's noise adds to them is not known, get that
/// of the seeds alone: what another run with other seeds would give against the same reference; `floor` bounds the
/// rest. Points in `without_seeds` do not depend on seeds: the reference's noise is all of their interval. Of the
/// others a single seed has none. Where the noise of the lit colour is known, what it leaves of the value joins, too,
/// and the lower end reaches down by what it adds: `value` still holds that, as it may be less. Intervals of errors end
/// at 0.
std::vector<MetricSummary> summarise(std::span<const ResultRow> rows, const PointSet& without_seeds = {});

/// One stage of one variant point: the median over the measured frames of all seeds of its time in a frame, with its
/// interval from order statistics.
struct TimeSummary {
    std::string shot, variant, point, stage, clock;
    size_t frames = 0;
    double median = 0, low = 0, high = 0;  ///< ms; the range where there are fewer than 6 frames
    double disturbed_share = 0;            ///< of the frames: other work took too much of the machine meanwhile
};
std::vector<TimeSummary> summarise(std::span<const TimeRow> rows);

/// Writes summary.csv and time_summary.csv, which the report and the figures show.
void write_summaries(const std::filesystem::path& folder, std::span<const MetricSummary> errors,
                     std::span<const TimeSummary> times);
