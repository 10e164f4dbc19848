#include "experiments/results/verdicts/effects/scatter_over_scenes.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace {

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / double(values.size());
}

bool says_nothing(const PointsByLaw& points, size_t least_points) {
    return points.size() < least_points || points.front()->front().size() < least_scenes;
}

/// What neither the scene nor the point explains of the values: squared, and summed over the scenes of each point.
std::vector<double> residual_squares(const PointsByLaw& points, size_t law) {
    const size_t scenes = points.front()->at(law).size();
    std::vector<double> of_points, of_scenes(scenes, 0.0), squares;
    for (const ScenesByLaw* point : points) {
        of_points.push_back(mean_of((*point)[law]));
        for (size_t s = 0; s < scenes; ++s) of_scenes[s] += (*point)[law][s] / double(points.size());
    }
    const double total = mean_of(of_points);
    for (size_t i = 0; i < points.size(); ++i) {
        double& sum = squares.emplace_back(0);
        for (size_t s = 0; s < scenes; ++s)
            sum += std::pow((*points[i])[law][s] - of_points[i] - of_scenes[s] + total, 2);
    }
    return squares;
}

}  // namespace

PooledScatter::Moderated PooledScatter::moderated(double own, size_t scenes, double share) const {
    const double n = double(scenes);
    if (!(degrees > 0)) return {own, n - 2};
    return {(degrees * share * variance + (n - 1) * own) / (degrees + n - 1), degrees + n - 1};
}

std::array<PooledScatter, noise_laws> pooled_scatter(const PointsByLaw& points) {
    std::array<PooledScatter, noise_laws> pooled;
    if (says_nothing(points, 3)) return pooled;
    const double k = double(points.size()), n = double(points.front()->front().size());
    for (size_t law = 0; law < noise_laws; ++law) {
        // A difference of two points has twice the variance of one, mean over all pairs.
        const double variance = 2 * k * mean_of(residual_squares(points, law)) / ((n - 1) * (k - 1));
        if (variance > 0) pooled[law] = {variance, std::min(pooled_degrees, (k - 2) * (n - 1))};
    }
    return pooled;
}

std::vector<ChanceOverScenes> chances_over_scenes(const PointsByLaw& points,
                                                  const std::array<PooledScatter, noise_laws>& pooled) {
    if (says_nothing(points, 2)) return {};
    constexpr size_t draws = 6000;  // known to 0.6 %
    const size_t scenes = points.front()->front().size();
    const double k = double(points.size()), n = double(scenes);
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    std::vector<ChanceOverScenes> chances(points.size());
    for (size_t law = 0; law < noise_laws; ++law) {
        std::vector<double> means, errors, drawn(points.size());
        double degrees = 0;
        for (const double squares : residual_squares(points, law)) {
            const double own = squares / ((n - 1) * (1 - 1 / k));
            const auto [variance, its_degrees] = pooled[law].moderated(own, scenes, 0.5);
            errors.push_back(std::sqrt(variance / n)), degrees = its_degrees;
        }
        for (const ScenesByLaw* point : points) means.push_back(mean_of((*point)[law]));
        std::chi_squared_distribution<double> chi_squared(degrees);
        for (size_t draw = law; draw < draws; draw += noise_laws) {
            const double wider = std::sqrt(degrees / chi_squared(random));
            for (size_t i = 0; i < drawn.size(); ++i) drawn[i] = means[i] + wider * errors[i] * normal(random);
            const auto least = std::ranges::min_element(drawn);
            chances[size_t(least - drawn.begin())].first += 1.0 / draws;
            for (size_t i = 0; i < drawn.size(); ++i)
                chances[i].near += (drawn[i] - *least <= std::log1p(near_first)) / double(draws);
        }
    }
    return chances;
}
