#include "experiments/results/tradeoff/draws.h"

#include "experiments/results/tradeoff/numpy_random.h"
#include "metrics/statistics/estimates.h"
#include "metrics/statistics/median_interval.h"
#include "metrics/statistics/quantiles.h"

#include <algorithm>
#include <cmath>

namespace {

/// Deviates by what points share them for, each drawn where it is first asked for.
template <class Name>
class SharedDeviates {
public:
    SharedDeviates(NumpyRandom& random, size_t count) : random_(random), count_(count) {}
    const std::vector<double>& operator[](const Name& name) {
        std::vector<double>& own = deviates_[name];
        while (own.size() < count_) own.push_back(random_.normal());
        return own;
    }

private:
    NumpyRandom& random_;
    size_t count_;
    std::map<Name, std::vector<double>> deviates_;
};

std::vector<double> values_of(const auto& named) {
    std::vector<double> values;
    for (const auto& [name, value] : named) values.push_back(value);
    return values;
}

std::vector<std::vector<double>> errors_of(std::span<const MeasuredPoint* const> points, NumpyRandom& random,
                                           size_t count) {
    std::vector<double> uniform(count), of_lit_colour(count);
    for (double& u : uniform) u = std::clamp(random.uniform(), 1e-6, 1.0);
    for (double& u : of_lit_colour) u = random.uniform();
    SharedDeviates<std::pair<std::string, unsigned>> normals(random,
                                                             count);  // of a seed, or of a technique's reference
    std::map<size_t, std::vector<double>> chi_by_degrees;             // which makes a normal deviate one of Student's t
    std::vector<std::vector<double>> drawn;
    for (const MeasuredPoint* p : points) {
        const double error = p->error(), high = p->row.error_high.value_or(error),
                     low = p->row.error_low.value_or(error);
        std::vector<double> relative(count, 0);
        double of_seeds = 0;
        if (const size_t k = p->seeds.size(); k > 1) {
            const std::vector<double> values = values_of(p->seeds);
            const Estimate mean = mean_estimate(values);
            of_seeds = (mean.high - mean.low) / 2;
            std::vector<double>& chi = chi_by_degrees[k - 1];
            for (size_t i = chi.size(); i < count; ++i)
                chi.push_back(std::sqrt(chi_squared_quantile(uniform[i], double(k - 1)) / double(k - 1)));
            // A deviate for each seed times its deviation has the variance of the mean.
            for (const auto& [seed, value] : p->seeds) {
                const std::vector<double>& normal = normals[{"", seed}];
                for (size_t i = 0; i < count; ++i) relative[i] += (value - mean.value) * normal[i];
            }
            for (size_t i = 0; i < count; ++i) relative[i] /= std::sqrt(double(k * (k - 1))) * chi[i] * error;
        }
        const double up = std::max(high - error, 0.0), below = std::max(error - low, 0.0);
        const double rest = std::sqrt(std::max(up * up - of_seeds * of_seeds, 0.0)) / normal_95;
        const double down = low <= 0 ? std::min(below, up) : below;
        const std::vector<double>& normal = normals[{p->row.technique, 0}];
        std::vector<double>& own = drawn.emplace_back();
        for (size_t i = 0; i < count; ++i) {
            // What the noise of the lit colour adds reaches down alone (LitNoise).
            const double moved = relative[i] + (rest * normal[i] - of_lit_colour[i] * std::max(down - up, 0.0)) / error;
            own.push_back(error * std::exp(std::clamp(moved, -20.0, 20.0)));
        }
    }
    return drawn;
}

std::vector<std::vector<double>> costs_of(std::span<const MeasuredPoint* const> points, NumpyRandom& random,
                                          size_t count) {
    SharedDeviates<std::pair<unsigned, unsigned>> normals(random, count);
    std::vector<std::vector<double>> drawn;
    for (const MeasuredPoint* p : points) {
        std::vector<double>& own = drawn.emplace_back(count, p->cost());
        if (p->rounds.empty()) continue;
        const std::vector<double> values = values_of(p->rounds);
        const double n = double(values.size()), scatter = std::sqrt(sign_variance_factor(values)) / 2;
        std::vector<double> ascending = values, offset(count, 0);
        std::ranges::sort(ascending);
        const double median = quantile_of(ascending, 0.5);
        for (const auto& [round, ms] : p->rounds) {
            const std::vector<double>& normal = normals[round];
            const double sign = ms > median ? 1 : ms < median ? -1 : 0;
            for (size_t i = 0; i < count; ++i) offset[i] += sign * normal[i];
        }
        for (size_t i = 0; i < count; ++i) {
            const double place = std::clamp(n / 2 + scatter * offset[i] - 0.5, 0.0, n - 1);
            own[i] = n > 1 ? quantile_of(ascending, place / (n - 1)) : ascending[0];
        }
    }
    return drawn;
}

}  // namespace

bool MeasuredPoint::is_judged() const {
    return row.verdict == "front" || row.verdict == "dominated" || row.verdict == "undecided";
}

Draws draws_of(std::span<const MeasuredPoint* const> points, unsigned seed, size_t count) {
    NumpyRandom random(seed);
    Draws draws;
    draws.errors = errors_of(points, random, count);
    draws.costs = costs_of(points, random, count);
    return draws;
}

double quantile_of(std::span<const double> ascending, double share) {
    const double place = share * double(ascending.size() - 1);
    const size_t left = std::min(size_t(place), ascending.size() - 1);
    const size_t right = std::min(left + 1, ascending.size() - 1);
    return std::lerp(ascending[left], ascending[right], place - double(left));
}
