#include "experiments/results/verdicts/judged_sequences.h"

#include "experiments/results/verdicts/power.h"
#include "metrics/direction.h"
#include "metrics/statistics/quantiles.h"
#include "metrics/video_jod.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace {

/// The values of one metric over the frames of a shot, by seed.
using BySeed = std::map<unsigned, std::optional<double>>;
struct BothSides {
    BySeed now, before;
};

std::map<std::string, BothSides> values_over_frames(std::span<const ResultRow> rows, const std::string& metric,
                                                    const std::string& mask, const PointName& point,
                                                    const PointName& against) {
    std::map<std::string, BothSides> shots;
    for (const ResultRow& r : rows) {
        const PointName name(r.technique, r.point);
        if (r.metric != metric || r.mask != mask || r.frame != over_frames || (name != point && name != against))
            continue;
        (name == point ? shots[r.shot].now : shots[r.shot].before)[r.seed] = r.value;
    }
    return shots;
}

bool is_zero(const BySeed& values) {
    return std::ranges::all_of(values, [](const auto& v) { return v.second == 0.0; });
}

/// Of a side that flickers and one that does not at all, which needs no statistics.
Evidence certain_flicker(const std::string& shot, bool is_worse) {
    return {.shot = shot,
            .what = judged_number::flicker,
            .change = is_worse ? INFINITY : 0,
            .p_different = 0,
            .no_interval = is_worse ? "the earlier frames have none" : "only the earlier frames have any"};
}

/// The value of a seed; a side with one image has all seeds, as in effects.
std::optional<double> value_of(const BySeed& side, unsigned seed) {
    if (side.size() == 1) return side.begin()->second;
    const auto found = side.find(seed);
    return found == side.end() ? std::nullopt : found->second;
}

const std::vector<float>* noise_sums(std::span<const ReferenceNoise> noise, const std::string& shot,
                                     const std::string& metric, const std::string& mask, const PointName& point) {
    for (const ReferenceNoise& n : noise)
        if (n.shot == shot && PointName(n.technique, n.point) == point && n.metric == metric && n.mask == mask)
            return &n.sums;
    return nullptr;
}

/// A mean difference: Student's t.
struct Difference {
    double value = 0, standard_error = 0, degrees = 1;

    /// One-sided p-value of "it is not above 0".
    double p_above() const {
        if (!(standard_error > 0)) return value > 0 ? 0 : 1;
        return student_t_cdf(-value / standard_error, degrees);
    }
};

/// Shares of ghosts, or distances in JOD: of common seeds, and of the groups of the reference's noise.
struct Shares {
    std::vector<double> now, before;
    std::vector<float> noise_now, noise_before;

    double mean_before() const {
        double sum = 0;
        for (const double b : before) sum += b;
        return sum / double(before.size());
    }

    /// of_now * now - of_before * before - constant. The variances of seeds and of noise add, with Satterthwaite's
    /// degrees of freedom (as jackknifed_ratio() has them); each group of noise is one component.
    Difference difference(double of_now, double of_before, double constant = 0) const {
        const double n = double(now.size());
        double sum = 0, squares = 0;
        const auto of_seed = [&](size_t s) { return of_now * now[s] - of_before * before[s]; };
        for (size_t s = 0; s < now.size(); ++s) sum += of_seed(s);
        for (size_t s = 0; s < now.size(); ++s) squares += std::pow(of_seed(s) - sum / n, 2);
        const double of_seeds = n > 1 ? squares / (n - 1) / n : 0;
        double variance = of_seeds, share = n > 1 ? of_seeds * of_seeds / (n - 1) : 0;
        for (size_t g = 0; g < std::min(noise_now.size(), noise_before.size()); ++g) {
            const double part = std::pow(of_now * noise_now[g] - of_before * noise_before[g], 2);
            variance += part, share += part * part;
        }
        return {sum / n - constant, std::sqrt(variance), share > 0 ? variance * variance / share : 1};
    }
};

/// Of the seeds that both sides have.
Shares shares_of(const BothSides& sides) {
    Shares shares;
    for (const auto& [seed, value] : sides.now.size() == 1 ? sides.before : sides.now)
        if (const auto now = value_of(sides.now, seed), before = value_of(sides.before, seed); now && before)
            shares.now.push_back(*now), shares.before.push_back(*before);
    return shares;
}

/// By shot; those without a value of both sides are left out. The noise is empty where it is not known.
std::map<std::string, Shares> shares_by_shot(std::span<const ResultRow> rows, std::span<const ReferenceNoise> noise,
                                             const std::string& metric, const std::string& mask, const PointName& point,
                                             const PointName& against) {
    std::map<std::string, Shares> shots;
    for (const auto& [shot, sides] : values_over_frames(rows, metric, mask, point, against)) {
        Shares shares = shares_of(sides);
        if (shares.now.empty()) continue;
        const auto *own = noise_sums(noise, shot, metric, mask, point),
                   *other = noise_sums(noise, shot, metric, mask, against);
        if (own && other) shares.noise_now = *own, shares.noise_before = *other;
        shots.emplace(shot, std::move(shares));
    }
    return shots;
}

/// What Shares are of.
struct Judged {
    const char* what;        ///< judged_number::
    double visible;          ///< the least share that counts
    bool has_nothing_below;  ///< shares below 0 are no ghosts; distances never are below 0
};

Evidence evidence_of(const std::string& shot, const Judged& judged, const Shares& shares, const JudgeLimits& limits) {
    const double before = shares.mean_before(), more = limits.worse_by - 1, visible = judged.visible;
    const bool is_visible = std::abs(before) >= visible;
    const Difference change = shares.difference(1, 1);
    const Difference beyond =
        is_visible ? shares.difference(1, before > 0 ? 1 + more : 1 - more) : shares.difference(1, 1, more * visible);
    const double allowed = more * std::max(std::abs(before), visible);
    const Difference less = {-change.value, change.standard_error, change.degrees};
    double p_worse = beyond.p_above(), p_better = less.p_above();
    if (judged.has_nothing_below) {  // more is worse where it is above 0, and less is better where it was above 0
        p_worse = std::max(p_worse, shares.difference(1, 0).p_above());
        p_better = std::max(p_better, shares.difference(0, -1).p_above());
    }
    const double half_width =
        change.standard_error > 0 ? student_t_quantile(0.975, change.degrees) * change.standard_error : 0;
    return {
        .shot = shot,
        .what = judged.what,
        .change = change.value,
        .low = change.value - half_width,
        .high = change.value + half_width,
        .no_change = 0,
        .p_different = std::min(1.0, 2 * std::min(p_worse, p_better)),
        .p_equivalent =
            p_beyond_limits(change.value, std::max(visible, allowed), change.standard_error, change.degrees),
        .detectable = allowed + (beyond.standard_error > 0
                                     ? effects_seen(beyond.degrees, judge_significance, 0.95) * beyond.standard_error
                                     : 0)};
}

}  // namespace

std::vector<Evidence> evidence_of_flicker(std::span<const EffectRow> effects, std::span<const ResultRow> rows,
                                          const PrimaryComparisons& primary, const PointName& point,
                                          const PointName& against, const JudgeLimits& limits) {
    std::vector<Evidence> evidence;
    for (const auto& [shot, sides] : values_over_frames(rows, "frame_difference", primary.mask, point, against)) {
        const bool is_still = is_zero(sides.now), was_still = is_zero(sides.before);
        if (is_still && was_still) continue;
        if (is_still || was_still) {
            evidence.push_back(certain_flicker(shot, was_still));
            continue;
        }
        const auto row = std::ranges::find_if(effects, [&](const EffectRow& r) {
            return r.shot == shot && r.metric == "frame_difference" && r.mask == primary.mask &&
                   PointName(r.technique, r.point) == point &&
                   PointName(r.against_technique, r.against_point) == against;
        });
        const bool is_known = row != effects.end() && row->p && row->ratio && row->low && row->high;
        evidence.push_back(is_known
                               ? evidence_of_ratio(*row, judged_number::flicker, limits, primary.margin)
                               : Evidence{.shot = shot,
                                          .what = judged_number::flicker,
                                          .no_interval = row == effects.end() ? interval::no_value : row->interval});
    }
    return evidence;
}

std::vector<Evidence> evidence_of_ghosts(std::span<const ResultRow> rows, std::span<const ReferenceNoise> noise,
                                         const std::string& mask, const PointName& point, const PointName& against,
                                         const JudgeLimits& limits) {
    std::vector<Evidence> evidence;
    for (const auto& [shot, shares] : shares_by_shot(rows, noise, "ghost_share", mask, point, against))
        evidence.push_back(evidence_of(shot, {judged_number::ghosts, visible_ghost, true}, shares, limits));
    return evidence;
}

std::vector<Evidence> evidence_of_visibility(std::span<const ResultRow> rows, std::span<const ReferenceNoise> noise,
                                             const PointName& point, const PointName& against,
                                             const JudgeLimits& limits) {
    const std::string metric = video_jod_name;
    std::vector<Evidence> evidence;
    for (auto& [shot, shares] : shares_by_shot(rows, noise, metric, "all", point, against)) {
        if (shares.noise_now.empty()) continue;
        for (std::vector<double>* side : {&shares.now, &shares.before})
            for (double& jod : *side) jod = greatest_value(metric) - jod;
        evidence.push_back(evidence_of(shot, {judged_number::visibility, visible_jod, false}, shares, limits));
    }
    return evidence;
}
