#pragma once
#include "experiments/results/tradeoff/draws.h"

/// What is read off a curve, with its 95 % interval.
struct ReadOff {
    std::optional<double> value, low, high;
    double share = 0;  ///< of the draws that have a value
};

/// A technique's own front in one shot: the error that a cost buys, and the cost that an error asks for. Between
/// measured points both are interpolated, logarithmic on both axes. Beyond the first and the last nothing was measured:
/// what is said there is an upper bound.
///
/// The front is chosen for its small errors, which chance made smaller: where few of several points that hardly differ
/// are on it, its numbers are too good. Lower ends are of draws that choose their fronts anew, which repeats that;
/// upper ends of whichever is more of these and of draws of the measured front's points, at 2.5 % shared among the
/// points whose place on the front is in doubt and the one that they would leave.
class Curve {
public:
    /// `points`: those of one technique, one or more; `rows`: their places among `draws`.
    Curve(std::vector<const MeasuredPoint*> points, const Draws& draws, std::span<const size_t> rows);

    /// Past the end no low end: a dearer point would perhaps err less. No value before the start.
    ReadOff error_at(double cost) const;
    /// From which cost on the error is at most `error`: the first cost of the front where that errs less already. No
    /// low end where 2.5 % of the draws err less from the start on: a cheaper point would perhaps do. No high end where
    /// more than 2.5 % of the draws do not reach the error.
    ReadOff cost_to(double error) const;

    const std::vector<const MeasuredPoint*>& points() const { return points_; }
    double start() const { return measured_.front().first; }  ///< the costs between which the front was measured
    double end() const { return measured_.back().first; }
    double start_error() const { return measured_.front().second; }

private:
    using Front = std::vector<std::pair<double, double>>;  // cost and error, by rising cost
    using Reading = std::optional<double> (*)(const Front& front, double asked);

    ReadOff read(Reading reading, double asked) const;

    std::vector<const MeasuredPoint*> points_;
    Front measured_;
    std::vector<Front> anew_, kept_;  ///< by draw: its own front, and the measured front's points
    double upper_ = 0;                ///< the quantile of upper ends
};
