#include "experiments/results/verdicts/effects/over_scenes.h"

#include "core/error.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/verdicts/family.h"
#include "experiments/results/verdicts/standings.h"
#include "experiments/results/verdicts/study_points.h"
#include "metrics/direction.h"
#include "metrics/statistics/estimates.h"
#include "metrics/statistics/quantiles.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace {

double mean_of(std::span<const double> values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / double(values.size());
}

/// The mean over the shots of each scene.
std::map<std::string, double> scene_means(std::span<const ShotValue> values) {
    std::map<std::string, std::vector<double>> of_scene;
    for (const ShotValue& v : values) of_scene[v.asset].push_back(v.value);
    std::map<std::string, double> means;
    for (const auto& [asset, of_shots] : of_scene) means[asset] = mean_of(of_shots);
    return means;
}

std::vector<double> values_of(const std::map<std::string, double>& of_scene) {
    std::vector<double> values;
    for (const auto& [asset, value] : of_scene) values.push_back(value);
    return values;
}

MeanOverScenes mean_of_scenes(std::span<const double> values, const PooledScatter& pooled = {}) {
    MeanOverScenes mean{.value = mean_of(values), .low = {}, .high = {}, .p = {}, .scenes = values.size()};
    if (values.size() < least_scenes) return mean;
    const double n = double(values.size());
    double squares = 0;
    for (const double v : values) squares += (v - mean.value) * (v - mean.value);
    // What is the same in all scenes, as the baseline beside itself, is known.
    const auto [variance, degrees] =
        (squares > 0 ? pooled : PooledScatter()).moderated(squares / (n - 1), values.size());
    mean.degrees = degrees, mean.standard_error = std::sqrt(variance / n);
    const double half_width = student_t_quantile(0.975, mean.degrees) * mean.standard_error;
    mean.low = mean.value - half_width, mean.high = mean.value + half_width;
    if (half_width > 0) mean.p = 2 * student_t_cdf(-std::abs(mean.value) / mean.standard_error, mean.degrees);
    return mean;
}

constexpr size_t laws = noise_laws;
using PooledByLaw = std::array<PooledScatter, laws>;

/// The mean of what was measured, with an interval and a p that hold by every law.
MeanOverScenes mean_by_laws(const ScenesByLaw& values, const PooledByLaw& pooled) {
    MeanOverScenes found = mean_of_scenes(values.front(), pooled.front());
    for (size_t law = 1; law < laws; ++law) {
        const MeanOverScenes other = mean_of_scenes(values[law], pooled[law]);
        if (other.low) found.low = std::min(*found.low, *other.low), found.high = std::max(*found.high, *other.high);
        if (other.p) found.p = std::max(found.p.value_or(0), *other.p);
        if (found.p && other.value * found.value < 0) found.p = 1;
    }
    return found;
}

/// By every law, of "the mean is not within the margin".
double p_beyond_by_laws(const ScenesByLaw& values, const PooledByLaw& pooled, double margin) {
    double p = 0;
    for (size_t law = 0; law < laws; ++law) {
        const MeanOverScenes mean = mean_of_scenes(values[law], pooled[law]);
        p = std::max(p, p_beyond_limits(mean.value, std::log1p(margin), mean.standard_error, mean.degrees));
    }
    return p;
}

std::optional<double> exponential(const std::optional<double>& value) {
    return value ? std::optional(std::exp(*value)) : std::nullopt;
}

using OfLaws = std::array<double, laws>;
using Logarithms = std::map<size_t, OfLaws>;  // by the index of the shot

ScenesByLaw over_scenes(const Logarithms& logarithms, std::span<const ShotErrors> shots) {
    ScenesByLaw values;
    for (size_t law = 0; law < laws; ++law) {
        std::vector<ShotValue> of_shots;
        for (const auto& [shot, of_laws] : logarithms) of_shots.push_back({shots[shot].asset, of_laws[law]});
        values[law] = values_of(scene_means(of_shots));
    }
    return values;
}

/// Places by the means over the scenes but one; those that are equal share the lower place.
std::vector<double> ranks(const std::vector<std::vector<double>>& of_points, std::optional<size_t> left_out) {
    std::vector<double> means, places;
    for (std::vector<double> values : of_points) {
        if (left_out) values.erase(values.begin() + std::ptrdiff_t(*left_out));
        means.push_back(mean_of(values));
    }
    for (const double own : means)
        places.push_back(1 + double(std::ranges::count_if(means, [&](double other) { return other < own; })));
    return places;
}

void set_ranks(const std::vector<OverScenes*>& points) {
    std::vector<std::vector<double>> of_points;
    for (const OverScenes* point : points) of_points.push_back(point->logarithms.front());
    const std::vector<double> places = ranks(of_points, {});
    for (size_t i = 0; i < points.size(); ++i) points[i]->rank = points[i]->rank_low = points[i]->rank_high = places[i];
    const size_t scenes = of_points.front().size();
    for (size_t left_out = 0; left_out < scenes && scenes > 1; ++left_out) {
        const std::vector<double> without = ranks(of_points, left_out);
        for (size_t i = 0; i < points.size(); ++i) {
            points[i]->rank_low = std::min(*points[i]->rank_low, without[i]);
            points[i]->rank_high = std::max(*points[i]->rank_high, without[i]);
        }
    }
}

/// Whether what all points say together is a third of what is known of a ratio's scatter. Over more scenes its own
/// scatter is most of it, and the range of all points, as if they had one, errs in 6 % of studies of 49 points.
bool shares_scatter(const PooledByLaw& pooled, const MeanOverScenes& mean) {
    constexpr size_t most_scenes = 8;
    return pooled.front().degrees > 0 && mean.scenes <= most_scenes;
}

/// Compares all with the first rank over the shots that both have, and decides who may be the best.
void set_standings(std::vector<OverScenes>& points, OverScenes& first, std::span<const ShotErrors> shots,
                   const std::map<PointName, Logarithms>& logarithms, const PooledByLaw& pooled, double margin) {
    std::vector<OverScenes*> compared;
    std::vector<AgainstBest> different;
    std::vector<double> beyond;
    for (OverScenes& point : points) {
        if (&point == &first) continue;
        Logarithms over_first;
        const Logarithms& of_first = logarithms.at({first.technique, first.point});
        for (const auto& [shot, of_laws] : logarithms.at({point.technique, point.point}))
            if (const auto own = of_first.find(shot); own != of_first.end())
                std::ranges::transform(of_laws, own->second, over_first[shot].begin(), std::minus());
        if (over_first.empty()) continue;
        const ScenesByLaw values = over_scenes(over_first, shots);
        const MeanOverScenes mean = mean_by_laws(values, pooled);
        point.over_best = std::exp(mean.value);
        point.over_best_low = exponential(mean.low), point.over_best_high = exponential(mean.high);
        if (mean.p) {
            compared.push_back(&point),
                different.push_back({0, *mean.p, shares_scatter(pooled, mean) ? mean.degrees : 0});
            beyond.push_back(p_beyond_by_laws(values, pooled, margin));
        }
        if (mean.scenes < least_scenes) continue;
        const double degrees = mean.degrees, deviation = mean.standard_error * std::sqrt(double(mean.scenes));
        point.scenes_needed = scenes_needed(deviation);
        point.scenes_needed_low = scenes_needed(deviation * std::sqrt(degrees / chi_squared_quantile(0.975, degrees)));
        point.scenes_needed_high = scenes_needed(deviation * std::sqrt(degrees / chi_squared_quantile(0.025, degrees)));
    }
    const std::array<size_t, 1> sizes = {compared.size() + 1};
    const std::vector<double> adjusted = adjusted_for_choice(different, sizes), equivalent = holm_adjusted(beyond);
    for (size_t i = 0; i < compared.size(); ++i)
        compared[i]->p_holm = adjusted[i], compared[i]->p_equivalent = equivalent[i];
    if (first.scenes < least_scenes || std::ranges::count_if(points, [](auto& o) { return o.rank.has_value(); }) < 2)
        return;
    first.standing = standing::best;
    for (OverScenes& point : points) {
        if (!point.rank || &point == &first) continue;
        // Without a p all scenes say the same.
        point.standing = standing::of(point.p_holm.value_or(1), point.p_equivalent.value_or(1));
        if (point.standing != standing::behind) first.standing = standing::tied;
    }
}

}  // namespace

MeanOverScenes mean_over_scenes(std::span<const ShotValue> values) {
    if (values.empty()) fail("a mean over scenes needs a value");
    return mean_of_scenes(values_of(scene_means(values)));
}

std::optional<std::pair<double, double>> bootstrap_over_scenes(std::span<const double> values, unsigned seed) {
    const size_t n = values.size(), resamples = 1999;
    if (n < least_scenes || std::ranges::count(values, values.front()) == std::ptrdiff_t(n)) return {};
    std::mt19937_64 random(seed);
    std::vector<double> means(resamples), resampled(n);
    for (double& mean : means) {
        for (double& v : resampled) v = values[random() % n];
        mean = mean_of(resampled);
    }
    std::ranges::sort(means);
    const double mean = mean_of(values);
    const auto [first, last] = std::ranges::equal_range(means, mean);  // those that are equal count half
    const double below = double((first - means.begin()) + (last - means.begin())) / double(2 * resamples);
    if (!(below > 0 && below < 1)) return {};
    double cubes = 0, squares = 0;  // of what the mean is without each value, the jackknife
    for (const double v : values) cubes += std::pow(v - mean, 3), squares += (v - mean) * (v - mean);
    const double bias = normal_quantile(below), acceleration = cubes / (6 * std::pow(squares, 1.5));
    const auto end = [&](double probability) {
        const double z = bias + normal_quantile(probability), moved = bias + z / (1 - acceleration * z);
        const double place = 0.5 * std::erfc(-moved / std::sqrt(2.0)) * double(resamples - 1);
        const size_t left = std::min(size_t(place), resamples - 2);
        return std::lerp(means[left], means[left + 1], place - double(left));
    };
    return std::pair(end(0.025), end(0.975));
}

MedianOverScenes median_over_scenes(std::vector<double> values) {
    if (values.empty()) fail("a median over scenes needs a value");
    std::ranges::sort(values);
    const size_t n = values.size();
    MedianOverScenes median{.value = 0.5 * (values[(n - 1) / 2] + values[n / 2]), .low = {}, .high = {}};
    // Outside of the values at ranks k and n + 1 - k lies the median with twice the probability of fewer than k heads.
    double of_count = std::exp2(-double(n)), below = 0;
    for (size_t k = 1; k <= n / 2; ++k) {
        below += of_count;
        if (2 * below > significance) break;
        median.low = values[k - 1], median.high = values[n - k];
        of_count *= double(n - k + 1) / double(k);
    }
    return median;
}

MedianOverScenes median_over_scenes(const ScenesByLaw& values) {
    MedianOverScenes found = median_over_scenes(values.front());
    for (size_t law = 1; law < laws; ++law) {
        const MedianOverScenes other = median_over_scenes(values[law]);
        if (other.low) found.low = std::min(*found.low, *other.low), found.high = std::max(*found.high, *other.high);
    }
    return found;
}

double scenes_needed(double deviation) {
    constexpr double power = 0.8;
    const double effects = deviation / std::log1p(worth_deciding);  // deviations in one difference
    double scenes = double(least_scenes);
    for (int step = 0; step < 50; ++step) {
        const double sum = student_t_quantile(0.975, scenes - 2) + student_t_quantile(power, scenes - 2);
        const double next = std::max(double(least_scenes), sum * sum * effects * effects);
        if (std::abs(next - scenes) < 0.01) break;
        scenes = 0.5 * (scenes + next);  // few scenes ask for many more, and these for few
    }
    return std::ceil(scenes);
}

std::vector<OverScenes> compare_over_scenes(std::span<const ShotErrors> shots, double lacking, double margin) {
    std::map<PointName, Logarithms> logarithms;
    size_t counted = 0;
    for (size_t i = 0; i < shots.size(); ++i) {
        if (!shots[i].divisor) continue;
        ++counted;
        for (const auto& [name, error] : shots[i].errors)
            if (error.low() > 0)
                std::ranges::transform(error.all(), shots[i].divisor->all(), logarithms[name][i].begin(),
                                       [](double own, double divisor) { return std::log(own / divisor); });
    }
    const auto is_ranked = [&](const Logarithms& own) { return double(own.size()) >= (1 - lacking) * double(counted); };
    std::vector<size_t> common;
    for (size_t i = 0; i < shots.size(); ++i)
        if (shots[i].divisor && std::ranges::all_of(logarithms, [&](const auto& entry) {
                return !is_ranked(entry.second) || entry.second.contains(i);
            }))
            common.push_back(i);
    std::vector<OverScenes> points;
    std::vector<PointName> ranked;
    for (auto& [name, own] : logarithms) {
        if (is_ranked(own) && !common.empty()) {
            ranked.push_back(name);
            std::erase_if(own, [&](const auto& entry) { return std::ranges::count(common, entry.first) == 0; });
        }
        OverScenes& point = points.emplace_back(OverScenes{.technique = name.first, .point = name.second});
        point.logarithms = over_scenes(own, shots), point.shots = own.size();
    }
    std::vector<OverScenes*> of_ranked;
    for (OverScenes& point : points)
        if (std::ranges::count(ranked, PointName(point.technique, point.point)) > 0) of_ranked.push_back(&point);
    PointsByLaw logarithms_of_ranked;
    for (const OverScenes* point : of_ranked) logarithms_of_ranked.push_back(&point->logarithms);
    const PooledByLaw pooled = pooled_scatter(logarithms_of_ranked);
    for (OverScenes& point : points) {
        const MeanOverScenes mean = mean_by_laws(point.logarithms, pooled);
        point.scenes = mean.scenes, point.ratio = std::exp(mean.value);
        point.low = exponential(mean.low), point.high = exponential(mean.high);
    }
    if (of_ranked.empty()) return points;
    set_ranks(of_ranked);
    const std::vector<ChanceOverScenes> chances = chances_over_scenes(logarithms_of_ranked, pooled);
    for (size_t i = 0; i < chances.size(); ++i)
        of_ranked[i]->chance_first = chances[i].first, of_ranked[i]->chance_near = chances[i].near;
    OverScenes& first = **std::ranges::min_element(of_ranked, {}, [](const OverScenes* o) { return *o->rank; });
    set_standings(points, first, shots, logarithms, pooled, margin);
    std::ranges::stable_sort(
        points, {}, [](const OverScenes& o) { return std::tuple(!o.rank.has_value(), o.rank.value_or(0), o.ratio); });
    return points;
}

PointName baseline_over_scenes(const nlohmann::json& manifest) {
    const nlohmann::json techniques = manifest.value("techniques", nlohmann::json::array());
    const auto name_of = [](const nlohmann::json& v) {
        return PointName(v.value("technique", ""), v.value("point", ""));
    };
    for (const nlohmann::json& v : techniques)
        if (v.value("technique", "") == "none") return name_of(v);
    for (const nlohmann::json& v : techniques)
        if (v.value("baseline", false)) return name_of(v);
    if (techniques.empty()) fail("manifest.json has no techniques");
    return name_of(techniques.front());
}

std::optional<Extrapolated> divisor_of(std::span<const MetricSummary* const> errors, const PointName& baseline) {
    double largest = -INFINITY;
    const MetricSummary* own = nullptr;
    for (const MetricSummary* e : errors) {
        largest = std::max(largest, *e->value);
        if (!own && PointName(e->technique, e->point) == baseline) own = e;
    }
    if (!own || !own->low || !(*own->low > 0) || !(own->extrapolated().low() > 0)) return {};
    const bool is_measure = *own->value > std::max(2 * own->floor.value_or(0), 1e-6 * largest);
    return is_measure ? std::optional(own->extrapolated()) : std::nullopt;
}

std::vector<OverScenesRow> errors_over_scenes(std::span<const MetricSummary> errors, const nlohmann::json& manifest,
                                              double margin, const std::vector<ComparedPoint>& compared) {
    using ErrorName = std::tuple<std::string, std::string, std::string>;  // target, metric, mask
    std::vector<ErrorName> names;
    std::map<ErrorName, std::vector<std::pair<std::string, std::vector<const MetricSummary*>>>> of_error;  // by shot
    for (const MetricSummary& e : errors) {
        if (!e.represents_shot || !e.value || direction_of(e.metric) != Better::lower) continue;
        const ErrorName name(e.target, e.metric, e.mask);
        if (!of_error.contains(name)) names.push_back(name);
        auto& shots = of_error[name];
        auto at = std::ranges::find(shots, e.shot, [](const auto& shot) { return shot.first; });
        if (at == shots.end()) at = shots.insert(at, {e.shot, {}});
        at->second.push_back(&e);
    }
    if (names.empty() || manifest.value("techniques", nlohmann::json::array()).empty()) return {};
    const PointSet using_scene = points_using_scene_data(manifest);
    const PointName baseline = baseline_over_scenes(manifest);
    std::vector<OverScenesRow> rows;
    for (const ErrorName& name : names) {
        std::vector<ShotErrors> shots, pairs;  // the latter with what uses scene data, too
        for (const auto& [shot, of_shot] : of_error[name]) {
            ShotErrors& own = shots.emplace_back(
                ShotErrors{.asset = asset_of(manifest, shot), .divisor = divisor_of(of_shot, baseline), .errors = {}});
            for (const MetricSummary* e : of_shot)
                if (e->counts_over_scenes()) own.errors[{e->technique, e->point}] = e->extrapolated();
            pairs.push_back(own);
            std::erase_if(own.errors, [&](const auto& error) { return using_scene.contains(error.first); });
        }
        const auto add = [&](OverScenes&& o, const PointName& divisor) {
            OverScenesRow& row = rows.emplace_back();
            static_cast<OverScenes&>(row) = std::move(o);
            std::tie(row.target, row.metric, row.mask) = name;
            std::tie(row.baseline_technique, row.baseline_point) = divisor;
        };
        for (OverScenes& o : compare_over_scenes(shots, most_lacking, margin)) add(std::move(o), baseline);
        for (const PointComparison& c : comparisons_of(compared)) {
            const PointName own(c.point->technique, c.point->point), other(c.baseline->technique, c.baseline->point);
            if (c.against == baseline_name) continue;
            std::vector<ShotErrors> of_pair;
            for (const ShotErrors& shot : pairs) {
                const auto a = shot.errors.find(own), b = shot.errors.find(other);
                if (shot.divisor && a != shot.errors.end() && b != shot.errors.end() && b->second.low() > 0)
                    of_pair.push_back({.asset = shot.asset, .divisor = b->second, .errors = {*a}});
            }
            for (OverScenes& o : compare_over_scenes(of_pair)) {
                o.rank = o.rank_low = o.rank_high = o.chance_first = o.chance_near = std::nullopt;
                add(std::move(o), other);
            }
        }
    }
    return rows;
}
