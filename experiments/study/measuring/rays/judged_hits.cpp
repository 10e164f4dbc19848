#include "experiments/study/measuring/rays/judged_hits.h"

#include "experiments/results/files/verdict_map.h"
#include "metrics/statistics/estimates.h"
#include "variants/tracers/outcome.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace {

const std::array<const char*, outcome_count> outcome_names = {"hit",         "off_screen",  "behind_camera",
                                                              "unfinished",  "background",  "too_thick",
                                                              "from_behind", "own_surface", "hidden"};

// `hit_coverage_study` measures the coverage of the intervals below.

/// Student's interval takes the seeds for normal, and knows nothing of what none of them showed. Rays that change their
/// verdict with the seed are often few: a count c over all seeds, estimated by their scatter, whose mean is known
/// within z^2/2 + z sqrt(c + z^2/4), the upper end of Wilson's score interval of a Poisson mean. The wider of both on
/// each side. `rays`: mean over the seeds. None with a single seed.
std::optional<Estimate> share_estimate(const std::vector<double>& shares, double rays) {
    if (shares.size() < 2) return {};
    constexpr double z = 1.96;
    const Estimate student = mean_estimate(shares);
    const double n = double(shares.size());
    double squares = 0;
    for (const double share : shares) squares += (share - student.value) * (share - student.value);
    const double changed = n / (n - 1) * squares * rays * rays;
    const double margin = (z * z / 2 + z * std::sqrt(changed + z * z / 4)) / (n * rays);
    return Estimate{student.value, std::max(std::min(student.low, student.value - margin), 0.0),
                    std::min(std::max(student.high, student.value + margin), 1.0)};
}

/// Of medians, and of means of what is not bounded: a single ray may move a seed by much, so that Student's interval of
/// fewer seeds or rays holds the truth too rarely (0.62 of the medians of less than 5 rays).
std::optional<Estimate> other_estimate(const std::vector<double>& values, double bearing_rays) {
    constexpr size_t fewest_seeds = 4;
    constexpr double fewest_rays = 20;
    if (values.size() < fewest_seeds || bearing_rays < fewest_rays) return {};
    return mean_estimate(values);
}

/// How much of a hit the ray counts as.
double hit_share(const RayRecord& ray) { return ray.outcome == outcome_hit ? double(ray.confidence) : 0.0; }

bool is_nothing(const ExactHit& truth) {
    return truth.outcome == outcome_background || truth.outcome == outcome_own_surface;
}

}  // namespace

const std::array<const char*, ray_verdict_count>& ray_verdict_names() {
    static const std::array<const char*, ray_verdict_count> names = {"right",          "wrong_place",      "false_hit",
                                                                     "avoidable_miss", "unavoidable_miss", "empty"};
    return names;
}

RayVerdict verdict_of_hit(const RayRecord& ray, const ExactHit& truth) {
    if (truth.outcome != outcome_hit) return RayVerdict::false_hit;
    const glm::ivec2 off = glm::abs(glm::ivec2(ray.pixel) - glm::ivec2(glm::floor(truth.position)));
    return std::max(off.x, off.y) <= 1 ? RayVerdict::right : RayVerdict::wrong_place;
}

RayVerdict verdict_of_miss(const ExactHit& truth) {
    return truth.outcome == outcome_hit ? RayVerdict::avoidable_miss
           : is_nothing(truth)          ? RayVerdict::empty
                                        : RayVerdict::unavoidable_miss;
}

void add_verdicts(VerdictSums& sums, const RayRecord& ray, const ExactHit& truth) {
    sums[size_t(verdict_of_hit(ray, truth))] += hit_share(ray);
    sums[size_t(verdict_of_miss(truth))] += 1.0 - hit_share(ray);
}

JudgedHits::Count& JudgedHits::count(const Key& key, unsigned seed) {
    auto entry = std::ranges::find(counts_, key, &std::pair<Key, std::vector<Count>>::first);
    if (entry == counts_.end()) entry = counts_.insert(counts_.end(), {key, {}});
    const auto known = std::ranges::find(seeds_, seed);
    const size_t index = size_t(known - seeds_.begin());
    if (known == seeds_.end()) seeds_.push_back(seed);
    if (entry->second.size() <= index) entry->second.resize(index + 1);
    return entry->second[index];
}

void JudgedHits::add(unsigned seed, const RecordedRays& recorded, const std::vector<ExactHit>& truth, glm::uvec2 extent,
                     unsigned every, const std::vector<Mask>& masks) {
    for (const Mask& mask : masks) {
        Count& sums = count({recorded.stage, mask.name}, seed);
        sums.missed_by_outcome.resize(outcome_count);
        for (size_t i = 0; i < recorded.rays.size(); ++i) {
            const RayRecord& ray = recorded.rays[i];
            const size_t pixel = i / recorded.rays_per_pixel;
            if (ray.is_traced == 0 || pixel >= size_t(extent.x) * extent.y) continue;
            if (pixel % extent.x % every != 0 || pixel / extent.x % every != 0) continue;
            if (!mask.inside.empty() && !mask.inside[pixel]) continue;
            const double share = hit_share(ray);
            ++sums.rays;
            ++sums.rays_by_fetches[ray.fetches];
            add_verdicts(sums.verdicts, ray, truth[i]);
            if (verdict_of_miss(truth[i]) == RayVerdict::avoidable_miss)
                sums.missed_by_outcome[std::min(ray.outcome, outcome_count - 1)] += 1.0 - share;
            if (share > 0 && verdict_of_hit(ray, truth[i]) == RayVerdict::right && truth[i].distance > 0)
                sums.distance_errors.push_back(std::abs(ray.distance / truth[i].distance - 1.0f));
        }
    }
}

std::optional<double> JudgedHits::median_distance_error(const Count& count) {
    if (count.distance_errors.empty()) return {};
    std::vector<float> errors = count.distance_errors;
    const auto middle = errors.begin() + std::ptrdiff_t(errors.size() / 2);
    std::ranges::nth_element(errors, middle);
    return double(*middle);
}

std::optional<double> JudgedHits::fetches_quantile(const Count& count, double share_below) {
    const double rank = std::min(std::floor(share_below * count.rays), count.rays - 1);
    double below = 0;
    for (const auto& [fetches, rays] : count.rays_by_fetches)
        if ((below += double(rays)) > rank) return double(fetches);
    return {};
}

std::vector<HitRow> JudgedHits::rows(const HitRow& shared) const {
    using ValueOf = std::function<std::optional<double>(const Count&)>;
    using RaysOf = std::function<double(const Count&)>;  // the number of rays behind a value that is no share
    std::vector<HitRow> rows;
    for (const auto& [key, seeds] : counts_) {
        const auto add = [&](const std::string& quantity, const ValueOf& value_of, const RaysOf& rays_of_other = {}) {
            std::vector<double> values;
            double rays = 0, bearing = 0;
            for (const Count& count : seeds) {
                if (count.rays == 0) continue;
                const std::optional<double> value = value_of(count);
                if (!value) continue;
                values.push_back(*value);
                rays += count.rays;
                bearing += rays_of_other ? rays_of_other(count) : 0.0;
            }
            if (values.empty()) return;
            const double n = double(values.size());
            HitRow row = shared;
            row.stage = key.stage, row.mask = key.mask, row.quantity = quantity, row.seeds = unsigned(values.size());
            row.rays = rays / n;
            row.value = std::accumulate(values.begin(), values.end(), 0.0) / n;
            if (const auto estimate =
                    rays_of_other ? other_estimate(values, bearing / n) : share_estimate(values, row.rays))
                row.low = std::max(estimate->low, 0.0), row.high = estimate->high;
            rows.push_back(std::move(row));
        };
        for (size_t v = 0; v < ray_verdict_count; ++v)
            add(ray_verdict_names()[v], [&](const Count& c) { return c.verdicts[v] / c.rays; });
        add("correct", [](const Count& c) {
            return (c.verdicts[size_t(RayVerdict::right)] + c.verdicts[size_t(RayVerdict::unavoidable_miss)] +
                    c.verdicts[size_t(RayVerdict::empty)]) /
                   c.rays;
        });
        for (size_t outcome = 0; outcome < outcome_count; ++outcome) {
            const auto share = [&](const Count& c) { return c.missed_by_outcome[outcome] / c.rays; };
            if (std::ranges::any_of(seeds, [&](const Count& c) { return c.rays > 0 && share(c) > 0; }))
                add(std::string("miss: ") + outcome_names[outcome], share);
        }
        add("distance_error", median_distance_error, [](const Count& c) { return double(c.distance_errors.size()); });
        const RaysOf all_rays = [](const Count& c) { return c.rays; };
        const ValueOf mean_fetches = [](const Count& c) {
            double sum = 0;
            for (const auto& [fetches, rays] : c.rays_by_fetches) sum += double(fetches) * double(rays);
            return sum / c.rays;
        };
        add("fetches", mean_fetches, all_rays);
        for (const auto& [name, share_below] :
             {std::pair("median", 0.5), std::pair("90 %", 0.9), std::pair("most", 1.0)})
            add(
                std::string("fetches: ") + name, [&](const Count& c) { return fetches_quantile(c, share_below); },
                all_rays);
    }
    return rows;
}

HostImage map_of_verdicts(const RecordedRays& recorded, const std::vector<ExactHit>& truth, glm::uvec2 extent) {
    const std::array<glm::vec3, ray_verdict_count> codes = {glm::vec3(0, 158, 115), {230, 159, 0}, {204, 121, 167},
                                                            {240, 228, 66},         {0, 114, 178}, {128, 128, 128}};
    HostImage map(extent, 3);
    for (size_t pixel = 0; pixel < map.pixel_count(); ++pixel) {
        const size_t i = pixel * recorded.rays_per_pixel;
        const RayRecord& ray = recorded.rays[i];
        if (ray.is_traced == 0) continue;
        const bool is_hit = ray.outcome == outcome_hit && ray.confidence >= 0.5f;
        const RayVerdict verdict = is_hit ? verdict_of_hit(ray, truth[i]) : verdict_of_miss(truth[i]);
        map.set_rgb(pixel, glm::pow(codes[size_t(verdict)] / 255.0f, glm::vec3(verdict_map_gamma)));
    }
    return map;
}
