#include "experiments/study/plan/ranking_warnings.h"

#include "core/list_text.h"
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "metrics/metric.h"
#include "metrics/noise.h"

#include <algorithm>
#include <set>

namespace {

std::string listed_names(const std::vector<std::string>& names) { return listed(names, 3); }

/// Per pixel, of the specular light; 0 where the study sets no limit of samples.
unsigned samples_of_reference(const ReferenceSettings& reference) {
    const bool has_other_stop = reference.max_seconds > 0 || reference.target_relative_error > 0;
    return reference.max_samples > 0 ? reference.max_samples : has_other_stop ? 0 : ReferenceSettings::default_samples;
}

bool is_mean_of_squares(const std::string& metric) {
    return std::ranges::any_of(all_metrics(),
                               [&](const Metric& m) { return m.name == metric && m.squared_error_weight; });
}

bool is_furnished(const std::string& scene) { return scene.starts_with("room:") || scene.starts_with("street:"); }

std::optional<std::string> warning_of_seeds(const Config& config, const StudyPlan& plan) {
    std::vector<std::string> points;
    for (const PointConfig& v : config.techniques)
        if (v.depends_on_seed && v.seeds.size() == 1 && !v.external)
            points.push_back(display_name(config, v.technique, v.point));
    if (points.empty()) return {};
    std::set<std::string> assets;
    for (const PlannedShot& shot : plan.shots) assets.insert(shot.entry.value("asset", shot.name));
    const std::string one = listed_names(points) + (points.size() == 1 ? " has" : " have") +
                            " 1 seed, so no shot ranks " + (points.size() == 1 ? "it" : "them");
    if (assets.size() >= least_scenes)
        return one + ". The " + std::to_string(assets.size()) + " scenes together still compare " +
               (points.size() == 1 ? "it" : "them") + ". To rank " + (points.size() == 1 ? "it" : "them") +
               " in each shot, set \"seeds\": 4.";
    return one + ". Set \"seeds\": 4.";
}

std::optional<std::string> warning_of_pixels(const Config& config, const StudyPlan& plan) {
    const unsigned samples = samples_of_reference(config.reference);
    std::vector<std::string> shots;
    for (const PlannedShot& shot : plan.shots)
        if (samples > 0 && double(shot.config.extent.x) * shot.config.extent.y * samples < least_noise_samples)
            shots.push_back(shot.name);
    if (shots.empty()) return {};
    return listed_names(shots) + ": all pixels together have fewer than " +
           std::to_string(unsigned(least_noise_samples)) +
           " samples of the reference, so no error has an interval. Increase reference.samples or the resolution.";
}

std::optional<std::string> warning_of_rooms(const Config& config, const StudyPlan& plan) {
    const unsigned samples = samples_of_reference(config.reference);
    if (!is_mean_of_squares(config.primary.metric) || samples == 0 || samples >= samples_of_rooms) return {};
    std::vector<std::string> rooms;
    for (const PlannedShot& shot : plan.shots)
        if (is_furnished(shot.config.scene) && !std::ranges::count(rooms, shot.config.scene))
            rooms.push_back(shot.config.scene);
    if (rooms.empty()) return {};
    const bool has_flip = std::ranges::count(config.metrics, "flip") > 0;
    return listed_names(rooms) + ": few paths find the lamps that furnished scenes reflect, so " +
           config.primary.metric + " with " + std::to_string(samples) +
           " samples detects only large differences there (metrics/README.md). " +
           (has_flip ? "Make flip the primary metric" : "Measure flip, and make it the primary metric") +
           ", or set reference.samples to " + std::to_string(samples_of_rooms) + ".";
}

}  // namespace

std::vector<std::string> ranking_warnings(const Config& config, const StudyPlan& plan) {
    if (!config.has_reference || config.metrics.empty()) return {};
    std::vector<std::string> warnings;
    const auto add = [&](const std::optional<std::string>& warning) {
        if (warning) warnings.push_back(*warning);
    };
    add(warning_of_seeds(config, plan));
    add(warning_of_pixels(config, plan));
    add(warning_of_rooms(config, plan));
    return warnings;
}
