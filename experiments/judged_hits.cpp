#include "experiments/judged_hits.h"

#include "metrics/statistics.h"
#include "variants/tracers/outcome.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

const std::array<const char*, outcome_count> outcome_names = {"hit",         "off_screen",  "behind_camera",
                                                              "unfinished",  "background",  "too_thick",
                                                              "from_behind", "own_surface", "hidden"};

constexpr double unbounded = std::numeric_limits<double>::infinity();  // of what is no share

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
            const double share = ray.outcome == outcome_hit ? double(ray.confidence) : 0.0;
            const RayVerdict if_hit = verdict_of_hit(ray, truth[i]), if_missed = verdict_of_miss(truth[i]);
            ++sums.rays;
            sums.fetches += ray.fetches;
            sums.verdicts[size_t(if_hit)] += share;
            sums.verdicts[size_t(if_missed)] += 1.0 - share;
            if (if_missed == RayVerdict::avoidable_miss)
                sums.missed_by_outcome[std::min(ray.outcome, outcome_count - 1)] += 1.0 - share;
            if (share > 0 && if_hit == RayVerdict::right && truth[i].distance > 0)
                sums.distance_errors.push_back(std::abs(ray.distance / truth[i].distance - 1.0f));
        }
    }
}

std::vector<HitRow> JudgedHits::rows(const HitRow& shared) const {
    std::vector<HitRow> rows;
    for (const auto& [key, seeds] : counts_) {
        const auto add = [&](const std::string& quantity, const auto& value_of, double most = 1.0) {
            std::vector<double> values;
            double rays = 0;
            for (const Count& count : seeds) {
                if (count.rays == 0) continue;
                const std::optional<double> value = value_of(count);
                if (!value) continue;
                values.push_back(*value);
                rays += count.rays;
            }
            if (values.empty()) return;
            HitRow row = shared;
            row.stage = key.stage, row.mask = key.mask, row.quantity = quantity, row.seeds = unsigned(values.size());
            row.rays = rays / double(values.size());
            double sum = 0;
            for (const double value : values) sum += value;
            row.value = sum / double(values.size());
            if (values.size() >= 2) {
                const Estimate estimate = mean_estimate(values);
                row.low = std::max(estimate.low, 0.0), row.high = std::min(estimate.high, most);  // a share stays one
            }
            rows.push_back(std::move(row));
        };
        for (size_t v = 0; v < ray_verdict_count; ++v)
            add(ray_verdict_names()[v],
                [&](const Count& c) -> std::optional<double> { return c.verdicts[v] / c.rays; });
        add("correct", [](const Count& c) -> std::optional<double> {
            return (c.verdicts[size_t(RayVerdict::right)] + c.verdicts[size_t(RayVerdict::unavoidable_miss)] +
                    c.verdicts[size_t(RayVerdict::empty)]) /
                   c.rays;
        });
        for (size_t outcome = 0; outcome < outcome_count; ++outcome) {
            const auto share = [&](const Count& c) -> std::optional<double> {
                return c.missed_by_outcome[outcome] / c.rays;
            };
            if (std::ranges::any_of(seeds, [&](const Count& c) { return c.rays > 0 && *share(c) > 0; }))
                add(std::string("miss: ") + outcome_names[outcome], share);
        }
        add(
            "distance_error",
            [](const Count& c) -> std::optional<double> {
                if (c.distance_errors.empty()) return {};
                std::vector<float> errors = c.distance_errors;
                const auto middle = errors.begin() + std::ptrdiff_t(errors.size() / 2);
                std::ranges::nth_element(errors, middle);
                return double(*middle);
            },
            unbounded);
        add(
            "fetches", [](const Count& c) -> std::optional<double> { return c.fetches / c.rays; }, unbounded);
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
        map.set_rgb(pixel, glm::pow(codes[size_t(verdict)] / 255.0f, glm::vec3(2.2f)));  // the PNG encodes it again
    }
    return map;
}
