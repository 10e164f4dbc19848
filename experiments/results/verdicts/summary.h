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
    std::optional<double> value;      ///< mean over the seeds; none if one of them has none
    std::optional<double> low, high;  ///< 95 % interval, see summarise()
    std::string interval = {};        ///< what it holds, or why there is none (interval.h)
    bool ranked = false;              ///< the interval holds all noise, so that it can be compared with other points'
    std::optional<double> seed_deviation;  ///< standard deviation over the seeds; none for a single one
    std::optional<double> floor;           ///< what the reference's own noise scores
    std::optional<double> lit_noise;       ///< what the noise of the lit colour adds to the value (LitNoise)
    bool corrected = false;
    /// `value` without the reference's noise, by either law of its growth (Extrapolated); none of errors that are freed
    /// of it, and where it is not known.
    std::optional<double> value_of_power, value_of_bounded;
    size_t pixels = 0, non_finite = 0, negative = 0;  ///< the last two are the worst seed's
    bool represents_shot = false;                     ///< see mark_representative_rows()
    std::string standing = {};  ///< among the points of its shot, see evaluation/standings.h; empty: not ranked
    std::optional<double> over_best, over_best_low, over_best_high;  ///< value / the least ranked one, where paired
    std::optional<double> p_best;        ///< of "no worse than the truly best", adjusted for the study
    std::optional<double> p_equivalent;  ///< of "not within the margin of the best measured", adjusted likewise
    std::string fronts = {};             ///< the costs against which the point is on the front, see set_fronts()
    std::string dominated = {};          ///< whether another point of the shot surely beats it, see set_dominated()

    /// The degrees of freedom that the interval has from its seeds; 0: it is of no seeds, and taken for a normal's.
    unsigned seed_degrees() const;

    /// `value` with and without the reference's noise: three times the same where that is no part of it.
    Extrapolated extrapolated() const;

    /// Whether it is one draw of what scenes are compared by: an estimate without bias, or with one that extrapolated()
    /// bounds, of however few seeds and paths of the reference. How these scatter is then part of how scenes do.
    bool counts_over_scenes() const;

    COLUMNS(MetricSummary, shot, frame, technique, point, target, metric, formula, mask, seeds, value, low, high,
            interval, ranked, seed_deviation, floor, lit_noise, corrected, value_of_power, value_of_bounded, pixels,
            non_finite, negative, represents_shot, standing, over_best, over_best_low, over_best_high, p_best,
            p_equivalent, fronts, dominated)
};

/// The interval of the mean over n seeds joins, in quadrature, what the reference's noise leaves (it is the same
/// reference for all seeds, so the mean of the rows' intervals) and Student's t interval of the seeds, t(0.975, n-1) s
/// / sqrt(n). Where rows have no interval, since what the reference's noise adds is not known, the mean has none,
/// unless the reference is exact (`floor` is 0): that of the seeds is then all there is. Points in `without_seeds` do
/// not depend on seeds: the reference's noise is all of their interval. Of the others a single seed has none. Where the
/// noise of the lit colour is known, what it leaves of the value joins, too, and the lower end reaches down by what it
/// adds: `value` still holds that, as it may be less. Intervals of errors end at 0. `noise`, of these rows' points,
/// tells the values without it.
std::vector<MetricSummary> summarise(std::span<const ResultRow> rows, const PointSet& without_seeds = {},
                                     std::span<const ReferenceNoise> noise = {});

/// One stage of one technique point: the median over the measured frames of all seeds of its time in a frame, with its
/// median_interval().
struct TimeSummary {
    std::string shot, technique, point, stage, clock;
    size_t frames = 0;
    double median = 0, low = 0, high = 0;  ///< ms
    double fits_from = 0;                  ///< ms: the point fits into budgets from here on ...
    double may_fit_from = 0;               ///< ... and not into those below this; in between it may fit
    double disturbed_share = 0;            ///< of the frames: other work took too much of the machine meanwhile

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

/// `floors`: shot to aa_floor(). A point fits into a budget if neither its interval's end nor the difference of two
/// copies of one point exceeds it.
std::vector<TimeSummary> summarise(std::span<const TimeRow> rows, const std::map<std::string, double>& floors = {});
