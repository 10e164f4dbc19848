#include "experiments/results/tradeoff/curves.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

using Place = std::pair<double, double>;  // cost and error
using Front = std::vector<Place>;

/// The indices of those with less error than all that cost less, by rising cost.
std::vector<size_t> front_of(const Front& places) {
    std::vector<size_t> order(places.size()), front;
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](size_t i) { return places[i]; });
    for (const size_t i : order)
        if (front.empty() || places[i].second < places[front.back()].second) front.push_back(i);
    return front;
}

Front taken(const Front& places, const std::vector<size_t>& indices) {
    Front front;
    for (const size_t i : indices) front.push_back(places[i]);
    return front;
}

double log_interpolated(double x, double x0, double x1, double y0, double y1) {
    const double share = std::log(x / x0) / std::log(x1 / x0);
    return std::exp((1 - share) * std::log(y0) + share * std::log(y1));
}

/// Errors of a front may rise where its points are those of another draw: each counts from its cost on.
std::optional<double> read_error(const Front& front, double cost) {
    const auto right = std::ranges::find_if(front, [&](const Place& p) { return p.first > cost; });
    if (right == front.begin()) return {};
    const Place& left = *(right - 1);
    if (right == front.end()) return left.second;
    return log_interpolated(cost, left.first, right->first, left.second, right->second);
}

/// Where the error is reached for good.
std::optional<double> read_cost(const Front& front, double error) {
    const auto last = std::find_if(front.rbegin(), front.rend(), [&](const Place& p) { return p.second > error; });
    const auto right = last.base();
    if (right == front.end()) return {};
    if (right == front.begin()) return right->first;
    const Place& left = *(right - 1);
    return log_interpolated(error, left.second, right->second, left.first, right->first);
}

}  // namespace

Curve::Curve(std::vector<const MeasuredPoint*> points, const Draws& draws, std::span<const size_t> rows)
    : points_(std::move(points)) {
    Front places;
    for (const MeasuredPoint* p : points_) places.emplace_back(p->cost(), p->error());
    const std::vector<size_t> measured = front_of(places);
    measured_ = taken(places, measured);
    const size_t count = draws.costs.front().size();
    std::vector<size_t> on_front(points_.size(), 0);
    for (size_t draw = 0; draw < count; ++draw) {
        for (size_t i = 0; i < points_.size(); ++i)
            places[i] = {draws.costs[rows[i]][draw], draws.errors[rows[i]][draw]};
        const std::vector<size_t> own = front_of(places);
        for (const size_t i : own) ++on_front[i];
        anew_.push_back(taken(places, own));
        kept_.push_back(taken(places, measured));
        std::ranges::sort(kept_.back());
    }
    const auto is_in_doubt = [&](size_t times) {
        const double share = double(times) / double(count);
        return share > 0.025 && share < 0.975;
    };
    upper_ = 1 - 0.025 / double(std::ranges::count_if(on_front, is_in_doubt) + 1);
}

ReadOff Curve::read(Reading reading, double asked) const {
    ReadOff found{.value = reading(measured_, asked)};
    std::vector<double> anew, larger;
    for (size_t draw = 0; draw < anew_.size(); ++draw) {
        const auto value = reading(anew_[draw], asked);
        if (!value) continue;
        anew.push_back(*value);
        larger.push_back(std::max(*value, reading(kept_[draw], asked).value_or(*value)));
    }
    found.share = double(anew.size()) / double(anew_.size());
    if (!found.value || anew.empty()) return found;
    std::ranges::sort(anew), std::ranges::sort(larger);
    found.low = quantile_of(anew, 0.025), found.high = quantile_of(larger, upper_);
    return found;
}

ReadOff Curve::error_at(double cost) const {
    ReadOff found = read(read_error, cost);
    if (cost > end()) found.low.reset();
    return found;
}

ReadOff Curve::cost_to(double error) const {
    ReadOff found = read(read_cost, error);
    const auto errs_less = [&](const Front& front) { return front.front().second <= error; };
    const double from_the_start = double(std::ranges::count_if(anew_, errs_less)) / double(anew_.size());
    if (error >= start_error() || from_the_start >= 0.025) found.low.reset();
    if (found.share < 0.975) found.high.reset();
    return found;
}
