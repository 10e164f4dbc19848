#include "tests/experiments/study/measuring/coverage.h"

#include "experiments/results/verdicts/effects/effects.h"
#include "experiments/results/verdicts/summary.h"
#include "experiments/study/measuring/measure.h"
#include "experiments/study/measuring/rung_errors.h"
#include "experiments/study/measuring/splits.h"
#include "tests/experiments/study/measuring/coverage_view.h"

#include <cmath>
#include <map>
#include <random>
#include <tuple>

namespace {

void accumulate(HostImage& sum, const HostImage& image, double weight) {
    for (size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += float(weight * image.values[i]);
}

/// The reference whose halves are the means of the even and of the odd seeds: independent of each other.
Reference mean_of(const std::vector<Reference>& seeds) {
    Reference mean = seeds.front();
    const auto outputs = [](Reference& r) {
        return std::array{&r.image,           &r.diffuse, &r.specular, &r.incident, &r.ladder.camera_radiance,
                          &r.ladder.on_screen};
    };
    for (ReferenceOutput* output : outputs(mean))
        for (HostImage* image : {&output->mean, &output->half_a, &output->half_b}) *image = HostImage(mean.extent, 3);
    const double share = 1.0 / double(seeds.size());
    for (size_t s = 0; s < seeds.size(); ++s) {
        Reference seed = seeds[s];
        const auto from = outputs(seed), to = outputs(mean);
        for (size_t i = 0; i < from.size(); ++i) {
            accumulate(s % 2 == 0 ? to[i]->half_a : to[i]->half_b, from[i]->mean, 2 * share);
            accumulate(to[i]->mean, from[i]->mean, share);
        }
    }
    return mean;
}

HostImage product(const HostImage& a, const HostImage& b) {
    HostImage result = a;
    for (size_t i = 0; i < result.values.size(); ++i) result.values[i] *= b.values[i];
    return result;
}

std::map<std::string, CompositedImages> tests(const View& view) {
    constexpr unsigned other_seed = 0x7e57;
    const Reference shown = view.reference(1024, other_seed), noisy = view.reference(16, other_seed + 1);
    const TruthLadder& ladder = shown.ladder;
    const HostImage confidence(view.extent, 1);
    return {{"fallback", {product(ladder.reflectance, ladder.fallback), ladder.fallback, confidence}},
            {"on_screen", {product(ladder.reflectance, ladder.on_screen.mean), ladder.on_screen.mean, confidence}},
            {"noisy", {noisy.specular.mean, noisy.incident.mean, confidence}}};
}

std::vector<Mask> masks(const View& view, const Reference& reference, unsigned draws) {
    std::vector<Mask> all = surface_masks(view, reference, {"all", "reflective", "edge"});
    std::vector<size_t> pixels;  // reflective ones, the quiet first
    for (size_t p = 0; p < all[1].inside.size(); ++p)
        if (all[1].inside[p]) pixels.push_back(p);
    std::ranges::stable_sort(pixels, {}, [&](size_t p) {
        const glm::vec3 v = reference.specular.variance.rgb(p);
        return v.x + v.y + v.z;
    });
    std::mt19937 random(1);
    const auto drawn = [&](const std::string& name, size_t count, size_t from) {
        Mask mask{.name = name, .extent = view.extent, .inside = std::vector<uint8_t>(all[0].inside.size())};
        for (size_t i = 0; i < count; ++i) mask.inside[pixels[random() % from]] = 1;
        return mask;
    };
    for (unsigned i = 0; i < draws; ++i) {
        all.push_back(drawn("ten", 10, pixels.size()));
        all.push_back(drawn("hundred", 100, pixels.size()));
        all.push_back(drawn("dominant", 40, pixels.size() / 2));
        all.back().inside[pixels[pixels.size() - 1 - i]] = 1;
    }
    return all;
}

/// Results of one reference, in an order that is the same for all of one view.
std::vector<ResultRow> results(const Reference& reference, const std::map<std::string, CompositedImages>& tests,
                               std::span<const Mask> masks, const CoverageSetting& setting) {
    Config config;
    config.targets = setting.targets, config.metrics = setting.metrics;
    const PoseTruth truth = pose_truth(reference, config, 0, {.has_targets = true});
    std::vector<ResultRow> rows;
    for (const auto& [name, images] : tests)
        for (ResultRow& row : measure_targets(truth, images, masks, {.technique = name}))
            rows.push_back(std::move(row));
    for (const nlohmann::json& e : rung_entries(truth, masks)) {
        ResultRow row{.technique = "rung " + e["rung"].get<std::string>()};
        row.target = e["target"], row.metric = e["metric"], row.mask = e["mask"], row.value = e["value"].get<double>();
        if (!e["low"].is_null()) row.low = e["low"].get<double>(), row.high = e["high"].get<double>();
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Sums first, then finished.
void add(CoverageRow& row, const ResultRow& result, double truth) {
    ++row.trials;
    if (!result.low || !result.high) return;
    ++row.intervals;
    // Values are sums of float32 products: 1e-9 of them is rounding, where the noise is nearly none.
    const double rounding = 1e-9 * std::abs(truth);
    row.covered += *result.low - rounding <= truth && truth <= *result.high + rounding;
    row.truth += truth, row.mean += *result.value, row.deviation += std::pow(*result.value - truth, 2);
    row.half_width += (*result.high - *result.low) / 2;
}

using CoverageKey = std::tuple<std::string, std::string, std::string, std::string>;  // test, target, mask, metric

/// Sums over trials as means.
std::vector<CoverageRow> finished(std::map<CoverageKey, CoverageRow> sums) {
    std::vector<CoverageRow> rows;
    for (auto& [key, row] : sums) {
        for (double* sum : {&row.truth, &row.mean, &row.deviation, &row.half_width}) *sum /= row.intervals;
        row.deviation = std::sqrt(row.deviation);
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace

std::vector<CoverageRow> coverage(const CoverageSetting& setting) {
    const View view(setting.scene, setting.extent);
    std::vector<Reference> seeds;
    for (unsigned seed = 0; seed < setting.seeds; ++seed) seeds.push_back(view.reference(setting.samples, seed));
    const Reference all = mean_of(seeds);
    const auto tested = tests(view);
    const std::vector<Mask> inside = masks(view, view.reference(256, setting.seeds), setting.draws);
    const std::vector<ResultRow> truth = results(all, tested, inside, setting);
    std::map<CoverageKey, CoverageRow> sums;
    for (const Reference& seed : seeds) {
        const std::vector<ResultRow> rows = results(seed, tested, inside, setting);
        for (size_t i = 0; i < rows.size(); ++i) {
            const ResultRow& r = rows[i];
            CoverageRow& row = sums[{r.technique, r.target, r.mask, r.metric}];
            row.scene = setting.scene, row.samples = setting.samples;
            row.test = r.technique, row.target = r.target, row.mask = r.mask, row.metric = r.metric;
            add(row, r, truth[i].value.value_or(NAN));
        }
    }
    return finished(std::move(sums));
}

namespace {

HostImage box_blurred(const HostImage& image) {
    constexpr int radius = 2;
    HostImage blurred(image.extent, 3);
    const int width = int(image.extent.x), height = int(image.extent.y);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::vec3 sum(0);
            float count = 0;
            for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
                for (int u = std::max(x - radius, 0); u <= std::min(x + radius, width - 1); ++u)
                    sum += image.rgb(size_t(v) * width + u), ++count;
            blurred.set_rgb(size_t(y) * width + x, sum / count);
        }
    return blurred;
}

/// `fallback`: the environment alone, which has no seed; `noisy`: the truth with the noise of 16 samples; `denoised`:
/// that noise blurred over 5x5 pixels.
Techniques simulated_techniques(const View& view, unsigned seeds) {
    constexpr unsigned other_seed = 0x7e57;
    const HostImage confidence(view.extent, 1);
    Techniques techniques{.baselines = {{"fallback", {"noisy", "denoised"}}}};
    const Reference shown = view.reference(16, other_seed);
    const HostImage& fallback = shown.ladder.fallback;
    techniques.images["fallback"].push_back({product(shown.ladder.reflectance, fallback), fallback, confidence, {}});
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        const Reference noisy = view.reference(16, other_seed + seed),
                        poor = view.reference(16, other_seed + 1000 + seed);
        techniques.images["noisy"].push_back({noisy.specular.mean, noisy.incident.mean, confidence, {}});
        const HostImage blurred = box_blurred(poor.specular.mean);
        techniques.images["denoised"].push_back({blurred, blurred, confidence, {}});
    }
    return techniques;
}

/// What is measured against one reference, and what its noise leaves of effects.
struct Measured {
    std::vector<ResultRow> rows;
    std::vector<ReferenceNoise> noise;
    std::vector<SplitRow> splits;
};

/// One number of a technique, or of its effect on another: with its interval, if that holds all noise.
struct Found {
    CoverageKey key;
    std::optional<double> value, low, high;
};

class TechniqueStudy {
public:
    TechniqueStudy(const Techniques& techniques, std::span<const Mask> masks, const CoverageSetting& setting)
        : techniques_(techniques), masks_(masks) {
        config_.targets = setting.targets, config_.metrics = setting.metrics;
    }

    /// All numbers against one reference, by `count` seeds from the one `first` on, which begin again at their end.
    std::vector<Found> found(const Reference& reference, unsigned first, unsigned count) const {
        const Measured measured = measure(reference, first, count);
        std::vector<Found> all;
        PointSet without_seeds;
        for (const auto& [name, images] : techniques_.images)
            if (images.size() == 1) without_seeds.insert({name, ""});
        for (const MetricSummary& s : summarise(measured.rows, without_seeds))
            all.push_back({{s.technique, s.target, s.mask, s.metric},
                           s.value,
                           s.ranked ? s.low : std::nullopt,
                           s.ranked ? s.high : std::nullopt});
        for (const SplitRow& s : measured.splits) {
            all.push_back({{s.technique, s.target, s.mask, "bias_squared"},
                           s.bias_squared,
                           s.bias_squared_low,
                           s.bias_squared_high});
            if (!without_seeds.contains({s.technique, ""}))
                all.push_back(
                    {{s.technique, s.target, s.mask, "variance"}, s.variance, s.variance_low, s.variance_high});
        }
        add_effects(all, measured);
        return all;
    }

private:
    Measured measure(const Reference& reference, unsigned first, unsigned count) const {
        Measured measured;
        const PoseTruth truth = pose_truth(reference, config_, 0, {.has_targets = true});
        for (const auto& [name, images] : techniques_.images) {
            SumsOfErrors noise;
            std::map<std::string, SeedSplit> splits;
            for (unsigned i = 0; i < std::min<size_t>(count, images.size()); ++i) {
                const CompositedImages& shown = images[(first + i) % images.size()];
                for (ResultRow& row :
                     measure_targets(truth, shown, masks_, {.frame = "0", .technique = name, .seed = i})) {
                    row.represents_shot = true;
                    add_growth(noise, {row.target, row.metric, row.mask, "0"}, row.growth);
                    measured.rows.push_back(std::move(row));
                }
                const HostImage image = composited_image(truth, shown);
                for (const auto& [target, against] : truth.targets) {
                    const HostImage& tested = tested_image(target, shown, image);
                    add_swapped_errors(noise, "0", target, against, tested, masks_);
                    splits.try_emplace(target, against).first->second.add(i, tested);
                }
            }
            for (ReferenceNoise& n : means_of(noise, {.technique = name})) measured.noise.push_back(std::move(n));
            for (const auto& [target, split] : splits)
                for (SplitRow& row :
                     split_rows(split, masks_, {.technique = name, .target = target, .mask = {}}, images.size() > 1))
                    measured.splits.push_back(std::move(row));
        }
        return measured;
    }

    void add_effects(std::vector<Found>& all, const Measured& measured) const {
        for (const auto& [baseline, others] : techniques_.baselines) {
            std::vector<ComparedPoint> points;
            const auto add_point = [&](const std::string& name) {
                ComparedPoint& point = points.emplace_back();
                point.technique = name, point.is_baseline = name == baseline;
                point.depends_on_seed = techniques_.images.at(name).size() > 1;
            };
            add_point(baseline);
            for (const std::string& name : others) add_point(name);
            const auto add = [&](const std::vector<EffectRow>& effects) {
                for (const EffectRow& e : effects)
                    all.push_back(
                        {{e.technique + " / " + e.against_technique, e.target, e.mask, "effect on " + e.metric},
                         e.ratio,
                         e.low,
                         e.high});
            };
            add(paired_effects(measured.rows, points, {}, measured.noise));
            add(split_effects(measured.splits, points));
        }
    }

    const Techniques& techniques_;
    std::span<const Mask> masks_;
    Config config_;
};

}  // namespace

std::vector<CoverageRow> technique_coverage(const CoverageSetting& setting, const Techniques& techniques,
                                            std::span<const Mask> masks, const Reference& truth,
                                            std::span<const Reference> references, unsigned technique_seeds) {
    const TechniqueStudy study(techniques, masks, setting);
    std::map<CoverageKey, double> truths;
    for (const Found& f : study.found(truth, 0, most_seeds)) truths[f.key] = f.value.value_or(NAN);
    std::map<CoverageKey, CoverageRow> sums;
    for (unsigned r = 0; r < references.size(); ++r)
        for (const Found& f : study.found(references[r], r * technique_seeds, technique_seeds)) {
            // A number that does not exist, such as the ratio of nothing, has no interval that could fail.
            const auto known = truths.find(f.key);
            if (known == truths.end() || !std::isfinite(known->second)) continue;
            CoverageRow& row = sums[f.key];
            row.scene = setting.scene, row.samples = setting.samples;
            std::tie(row.test, row.target, row.mask, row.metric) = f.key;
            ResultRow result;
            result.value = f.value, result.low = f.low, result.high = f.high;
            add(row, result, known->second);
        }
    return finished(std::move(sums));
}

std::vector<CoverageRow> technique_coverage(const CoverageSetting& setting, unsigned technique_seeds) {
    constexpr unsigned known_seeds = 64, truth_factor = 128;
    const View view(setting.scene, setting.extent);
    const Reference best = view.reference(truth_factor * setting.samples, setting.seeds + 1);
    std::vector<Reference> references;
    for (unsigned seed = 0; seed < setting.seeds; ++seed) references.push_back(view.reference(setting.samples, seed));
    return technique_coverage(setting, simulated_techniques(view, known_seeds),
                              surface_masks(view, best, {"all", "reflective"}), best, references, technique_seeds);
}
