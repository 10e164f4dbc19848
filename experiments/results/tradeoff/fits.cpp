#include "experiments/results/tradeoff/fits.h"

#include "metrics/statistics/quantiles.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <sstream>

namespace {

using nlohmann::json;

constexpr size_t least_points = 4;
constexpr size_t exponents = 321, floors = 801;
constexpr double least_exponent = 0.05, most_exponent = 16;

double exponent(size_t i) {
    if (i + 1 == exponents) return most_exponent;
    const double first = std::log10(least_exponent), last = std::log10(most_exponent);
    return i == 0 ? least_exponent : std::pow(10, first + double(i) * ((last - first) / double(exponents - 1)));
}

/// Of a number, or of a text that is one.
std::optional<double> as_number(const json& value) {
    if (value.is_number()) return value.get<double>();
    if (!value.is_string()) return {};
    const std::string text = value.get<std::string>();
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    std::istringstream stream(text);
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

/// What the labels of the axis' points share: `best` of `best rays=2` and `best rays=4`.
std::string fixed_part(const std::vector<const MeasuredPoint*>& points, const std::string& name) {
    std::vector<std::vector<std::string>> words;
    for (const MeasuredPoint* p : points)
        if (p->row.point.find(name + "=") != std::string::npos) {
            words.push_back(words_of(p->row.point));
            std::erase_if(words.back(), [&](const std::string& word) { return word.starts_with(name + "="); });
        }
    std::string shared;
    for (const std::string& word : words.empty() ? std::vector<std::string>{} : words.front())
        if (std::ranges::all_of(words, [&](const auto& other) { return std::ranges::count(other, word) > 0; }))
            shared += (shared.empty() ? "" : " ") + word;
    return shared;
}

double log_deviation(double value, double low, double high) {
    if (low <= 0) low = value * value / high;  // as far below as above
    return std::max(std::log(high / low) / (2 * normal_95), 1e-6);
}

struct LinearFit {
    double floor = 0, a = 0, squares = 0;
};

/// The floor >= 0 and a >= 0 of least weighted squares of `errors` = floor + a `powers`.
LinearFit best_linear(std::span<const double> powers, std::span<const double> errors, std::span<const double> weights) {
    double sw = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (size_t i = 0; i < errors.size(); ++i) {
        const double w = weights[i], x = powers[i], y = errors[i];
        sw += w, sx += w * x, sy += w * y, sxx += w * x * x, sxy += w * x * y;
    }
    const double determinant = sw * sxx - sx * sx;
    LinearFit fit{.a = determinant > 0 ? (sw * sxy - sx * sy) / determinant : 0.0};
    fit.floor = (sy - fit.a * sx) / sw;
    if (fit.floor < 0) fit.floor = 0, fit.a = sxy / sxx;
    if (fit.a < 0) fit.a = 0, fit.floor = sy / sw;
    for (size_t i = 0; i < errors.size(); ++i) {
        const double residual = errors[i] - fit.floor - fit.a * powers[i];
        fit.squares += weights[i] * residual * residual;
    }
    return fit;
}

/// The least squares that a floor leaves, whatever the exponent.
double squares_of_floor(double floor, const std::vector<std::vector<double>>& powers, std::span<const double> errors,
                        std::span<const double> weights) {
    double least = INFINITY;
    for (const std::vector<double>& x : powers) {
        double of_product = 0, of_square = 0, squares = 0;
        for (size_t i = 0; i < errors.size(); ++i)
            of_product += weights[i] * x[i] * (errors[i] - floor), of_square += weights[i] * x[i] * x[i];
        const double amount = std::max(of_product / of_square, 0.0);
        for (size_t i = 0; i < errors.size(); ++i) {
            const double residual = errors[i] - floor - amount * x[i];
            squares += weights[i] * residual * residual;
        }
        least = std::min(least, squares);
    }
    return least;
}

}  // namespace

std::vector<QualityAxis> quality_axes(std::span<const MeasuredPoint> points,
                                      const std::map<PointName, json>& parameters) {
    struct Group {
        std::string technique, name;
        json rest;  // of the parameters
        std::map<double, const MeasuredPoint*> of_value;
    };
    std::vector<Group> groups;
    for (const MeasuredPoint& p : points) {
        const auto own = parameters.find(p.name());
        if (own == parameters.end()) continue;
        for (const auto& [name, value] : own->second.items()) {
            const auto number = as_number(value);
            if (!number) continue;
            json rest = own->second;
            rest.erase(name);
            auto group = std::ranges::find_if(groups, [&](const Group& g) {
                return g.technique == p.row.technique && g.name == name && g.rest == rest;
            });
            if (group == groups.end()) group = groups.insert(group, {p.row.technique, name, std::move(rest), {}});
            group->of_value.emplace(*number, &p);
        }
    }
    std::vector<QualityAxis> axes;
    for (const Group& group : groups) {
        if (group.of_value.size() < least_points) continue;
        QualityAxis& axis = axes.emplace_back(QualityAxis{.technique = group.technique, .parameter = group.name});
        for (const auto& [value, p] : group.of_value) axis.points.push_back(p);
        axis.fixed = fixed_part(axis.points, group.name);
    }
    return axes;
}

Fit fit_law(std::span<const double> costs, std::span<const double> errors, std::span<const double> error_deviations,
            std::span<const double> cost_deviations) {
    const size_t n = costs.size();
    double scale = 0;
    for (const double cost : costs) scale += std::log(cost) / double(n);
    scale = std::exp(scale);
    std::vector<std::vector<double>> powers(exponents);
    for (size_t i = 0; i < exponents; ++i)
        for (const double cost : costs) powers[i].push_back(std::pow(cost / scale, -exponent(i)));
    std::vector<double> deviations(error_deviations.begin(), error_deviations.end()), weights(n);
    std::vector<LinearFit> linear(exponents);
    size_t best = 0;
    for (int round = 0; round < 4; ++round) {
        for (size_t i = 0; i < n; ++i) weights[i] = 1 / std::pow(deviations[i] * errors[i], 2);
        for (size_t i = 0; i < exponents; ++i) linear[i] = best_linear(powers[i], errors, weights);
        best = size_t(std::ranges::min_element(linear, {}, &LinearFit::squares) - linear.begin());
        for (size_t i = 0; i < n; ++i) {
            const double falls = linear[best].a * powers[best][i];
            const double slope = exponent(best) * falls / (linear[best].floor + falls);
            deviations[i] = std::hypot(error_deviations[i], slope * cost_deviations[i]);
        }
    }
    const double degrees = double(n) - 3, least = linear[best].squares, spread = std::max(1.0, least / degrees);
    const double quantile = spread == 1 ? normal_95 : student_t_quantile(0.975, degrees);
    const double limit = least + spread * quantile * quantile;
    const double misfit = std::sqrt(least / degrees);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double mean = std::inner_product(weights.begin(), weights.end(), errors.begin(), 0.0) / total;
    double of_constant = 0;
    for (size_t i = 0; i < n; ++i) of_constant += weights[i] * (errors[i] - mean) * (errors[i] - mean);
    if (of_constant <= limit || linear[best].a <= 0)
        return {.status = "the error does not surely fall with the cost", .misfit = misfit};
    Fit fit{.status = "fitted",
            .floor = linear[best].floor,
            .a = linear[best].a * std::pow(scale, exponent(best)),
            .b = exponent(best),
            .misfit = misfit};
    for (size_t i = 0; i < exponents; ++i)
        if (linear[i].squares <= limit) {
            if (!fit.b_low) fit.b_low = exponent(i);
            fit.b_high = exponent(i);
        }
    const double most = std::min(std::ranges::max(errors), 3 * std::ranges::min(errors)), step = most / (floors - 1);
    std::vector<double> profile;
    for (size_t i = 0; i < floors; ++i) profile.push_back(squares_of_floor(double(i) * step, powers, errors, weights));
    const double accepted = std::max(limit, std::ranges::min(profile));
    size_t low = floors, high = 0;
    for (size_t i = 0; i < floors; ++i)
        if (profile[i] <= accepted) low = std::min(low, i), high = i;
    fit.floor_low = std::max(double(low) * step - step, 0.0), fit.floor_high = double(high) * step + step;
    if (*fit.b_high >= most_exponent) {
        fit.status = "exponent has no upper end: the error falls in one step";
        fit.b_high.reset(), fit.a.reset(), fit.b.reset();
    } else if (*fit.b_low <= least_exponent) {
        fit.status = "exponent not distinguishable from 0";
        fit.b_low.reset(), fit.a.reset(), fit.b.reset();
    }
    return fit;
}

std::pair<std::vector<const MeasuredPoint*>, Fit> fit_axis(const QualityAxis& axis, double floor_of_costs) {
    std::vector<const MeasuredPoint*> points = axis.points;
    std::erase_if(points, [](const MeasuredPoint* p) { return !p->is_judged(); });
    if (points.size() < least_points)
        return {points, {.status = "only " + std::to_string(points.size()) + " of its points are judged"}};
    std::vector<double> costs, errors, of_errors, of_costs;
    for (const MeasuredPoint* p : points) {
        const FrontRow& row = p->row;
        costs.push_back(p->cost()), errors.push_back(p->error());
        of_errors.push_back(log_deviation(p->error(), *row.error_low, *row.error_high));
        of_costs.push_back(
            log_deviation(p->cost(), row.cost_low.value_or(p->cost()), row.cost_high.value_or(p->cost())));
    }
    const auto [least, most] = std::ranges::minmax(costs);
    if (most <= std::pow(1 + floor_of_costs, 2) * least)
        return {points, {.status = "its costs differ by less than two copies of one point may"}};
    return {points, fit_law(costs, errors, of_errors, of_costs)};
}
