#pragma once
#include "experiments/results/tradeoff/draws.h"

/// A value read off a curve, with its 95 % interval.
struct ReadOff {
    std::optional<double> value, low, high;
    double share = 0;  ///< share of the draws that have a value
};

/// A technique's front in one shot: the error at a cost, and the cost of an error. Between measured points both are
/// interpolated, logarithmic on both axes. Beyond the ends nothing was measured: values there are upper bounds.
///
/// A front selects small errors, which chance made smaller: its numbers are too good where it keeps few of several
/// similar points. Lower ends of intervals use draws that choose their fronts anew, which repeats this selection. Upper
/// ends use the larger of two quantiles: of such draws, and of draws of the measured front's points. Their level is 2.5
/// %, divided by the number of points whose place on the front is in doubt and the point that they would leave.
class Curve {
public:
    /// `points`: of one technique, at least one. `rows`: their places in `draws`.
    Curve(std::vector<const MeasuredPoint*> points, const Draws& draws, std::span<const size_t> rows);

    /// The error at a cost. No low end past the last point, as a dearer point might err less. No value before the
    /// first.
    ReadOff error_at(double cost) const;
    /// The cost from which on the error is at most `error`; the front's first cost if it already errs less. No low end
    /// if 2.5 % of the draws err less from the start: a cheaper point might suffice. No high end if more than 2.5 % of
    /// the draws do not reach the error.
    ReadOff cost_to(double error) const;

    const std::vector<const MeasuredPoint*>& points() const { return points_; }
    double start() const { return measured_.front().first; }  ///< first and last cost of the measured front
    double end() const { return measured_.back().first; }
    double start_error() const { return measured_.front().second; }

private:
    using Front = std::vector<std::pair<double, double>>;  // cost and error, by rising cost
    using Reading = std::optional<double> (*)(const Front& front, double asked);

    ReadOff read(Reading reading, double asked) const;

    std::vector<const MeasuredPoint*> points_;
    Front measured_;
    std::vector<Front> anew_, kept_;  ///< by draw: its own front, and the points of the measured front
    double upper_ = 0;                ///< quantile of the upper ends
};
