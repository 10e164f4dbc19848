#pragma once
#include "experiments/cell.h"
#include "experiments/effects.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// results.csv, splits.csv, effects.csv and times.csv as they were written. Every mistake in them is an Error that
/// names file, line and column.
std::vector<ResultRow> read_result_rows(const std::filesystem::path& file);
std::vector<SplitRow> read_split_rows(const std::filesystem::path& file);
std::vector<EffectRow> read_effect_rows(const std::filesystem::path& file);
std::vector<TimeRow> read_time_rows(const std::filesystem::path& file);

/// One metric of one variant point over all its seeds.
struct MetricSummary {
    std::string shot, frame, variant, point, target, metric, formula, mask;
    unsigned seeds = 0;
    std::optional<double> value;           ///< mean over the seeds; none if one of them has none
    std::optional<double> low, high;       ///< 95 % interval, see summarise()
    std::optional<double> seed_deviation;  ///< standard deviation over the seeds; none for a single one
    std::optional<double> floor;           ///< what the reference's own noise scores
    bool is_corrected = false;
    size_t pixels = 0, non_finite = 0, negative = 0;  ///< the last two are the worst seed's
};

/// The interval of the mean over n seeds joins, in quadrature, what the reference's noise leaves (it is the same
/// reference for all seeds, so the mean of the rows' intervals) and Student's t interval of the seeds, t(0.975, n-1) s
/// / sqrt(n). The seeds alone would understate it, so a metric gets none if a row lacks one end of its interval or
/// both; unless the reference is known to be exact (a floor of 0). Intervals of errors end at 0.
std::vector<MetricSummary> summarise(std::span<const ResultRow> rows);

/// One stage of one variant point: the median over the measured frames of all seeds of its time in a frame, with its
/// interval from order statistics.
struct TimeSummary {
    std::string shot, variant, point, stage, clock;
    size_t frames = 0;
    double median = 0, low = 0, high = 0;  ///< ms; the range where there are fewer than 6 frames
};
std::vector<TimeSummary> summarise(std::span<const TimeRow> rows);

/// Writes summary.csv and time_summary.csv, which the report and the figures show.
void write_summaries(const std::filesystem::path& folder, std::span<const MetricSummary> errors,
                     std::span<const TimeSummary> times);
