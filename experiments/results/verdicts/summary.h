#pragma once
#include "experiments/results/cells/cell.h"
#include "experiments/results/verdicts/effects/effects.h"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

/// One metric of one technique point over all its seeds.
struct MetricSummary {
    std::string shot, frame, technique, point, target, metric, formula, mask;
    unsigned seeds = 0;
    std::optional<double> value;           ///< mean over the seeds; none if any seed has none
    std::optional<double> low, high;       ///< 95 % interval, see summarise()
    std::string interval = {};             ///< what the interval includes, or why there is none (interval.h)
    bool ranked = false;                   ///< the interval includes all noise: points can be compared
    std::optional<double> seed_deviation;  ///< standard deviation over the seeds; none for a single one
    std::optional<double> floor;           ///< score of the reference's own noise
    std::optional<double> lit_noise;       ///< what the noise of the lit colour adds to the value (LitNoise)
    bool corrected = false;
    /// `value` without the reference's noise, by either law of its growth (Extrapolated). None for errors that are free
    /// of it, and where it is unknown.
    std::optional<double> value_of_power, value_of_bounded;
    size_t pixels = 0, non_finite = 0, negative = 0;  ///< the last two: of the worst seed
    bool represents_shot = false;                     ///< see mark_representative_rows()
    std::string standing = {};  ///< among the points of its shot, see standings.h; empty: not ranked
    std::optional<double> over_best, over_best_low, over_best_high;  ///< value / least ranked value, if paired
    std::optional<double> p_best;        ///< of "no worse than the truly best", adjusted for the study
    std::optional<double> p_equivalent;  ///< of "not within the margin of the best measured", adjusted
    std::string fronts = {};             ///< costs for which the point is on the front, see set_fronts()
    std::string dominated = {};          ///< whether another point of the shot beats it, see set_dominated()

    /// The interval's degrees of freedom from seeds; 0: no seeds, a normal's interval.
    unsigned seed_degrees() const;

    /// `value` with and without the reference's noise: three equal values if the noise does not affect it.
    Extrapolated extrapolated() const;

    /// Whether the value counts as one draw in comparisons over scenes: it has no bias, or one that extrapolated()
    /// bounds. The scatter by few seeds or paths of the reference is then part of the scatter over scenes.
    bool counts_over_scenes() const;

    COLUMNS(MetricSummary, shot, frame, technique, point, target, metric, formula, mask, seeds, value, low, high,
            interval, ranked, seed_deviation, floor, lit_noise, corrected, value_of_power, value_of_bounded, pixels,
            non_finite, negative, represents_shot, standing, over_best, over_best_low, over_best_high, p_best,
            p_equivalent, fronts, dominated)
};

/// Summarises rows over seeds. `noise`, of the same points, gives the values without the reference's noise.
///
/// The interval of the mean over n seeds joins these parts in quadrature:
///
/// - what the reference's noise leaves: the mean of the rows' intervals, as all seeds have the same reference
/// - Student's interval of the seeds, t(0.975, n-1) s / sqrt(n)
/// - the noise of the lit colour, where it is known; the lower end also reaches down by what it adds, as `value`
///   includes it
///
/// Intervals of errors end at 0. If the reference's noise is unknown, rows and mean have no interval; if the reference
/// is exact (`floor` is 0), the mean has that of the seeds. Points in `without_seeds` do not depend on seeds: their
/// interval is the reference's noise. A single seed of any other point has none.
std::vector<MetricSummary> summarise(std::span<const ResultRow> rows, const PointSet& without_seeds = {},
                                     std::span<const ReferenceNoise> noise = {});

/// Time of one stage of one point in a frame: the median over the measured frames of all seeds, with its
/// median_interval().
struct TimeSummary {
    std::string shot, technique, point, stage, clock;
    size_t frames = 0;
    double median = 0, low = 0, high = 0;  ///< ms
    double fits_from = 0;                  ///< ms: budgets of at least this certainly suffice
    double may_fit_from = 0;               ///< ms: budgets below this do not suffice; between both they may
    double disturbed_share = 0;            ///< share of frames that other work disturbed

    static constexpr auto columns() {
        return std::tuple(Column{"shot", &TimeSummary::shot}, Column{"technique", &TimeSummary::technique},
                          Column{"point", &TimeSummary::point}, Column{"stage", &TimeSummary::stage},
                          Column{"clock", &TimeSummary::clock}, Column{"frames", &TimeSummary::frames},
                          Column{"median_ms", &TimeSummary::median}, Column{"low_ms", &TimeSummary::low},
                          Column{"high_ms", &TimeSummary::high}, Column{"fits_from_ms", &TimeSummary::fits_from},
                          Column{"may_fit_from_ms", &TimeSummary::may_fit_from},
                          Column{"disturbed_share", &TimeSummary::disturbed_share});
    }
};

/// `floors`: aa_floor() by shot. A budget certainly suffices if neither the interval's end nor the difference of two
/// copies of one point exceeds it.
std::vector<TimeSummary> summarise(std::span<const TimeRow> rows, const std::map<std::string, double>& floors = {});
