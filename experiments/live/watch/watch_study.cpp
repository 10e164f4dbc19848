#include "experiments/live/watch/watch_study.h"

#include "core/error.h"
#include "variants/registry.h"

using nlohmann::json;

namespace {

/// What errs least over the scenes of the included studies (experiments/studies/questions).
constexpr const char* best_point = "frostbite_sssr:best";

json entry_of(const WatchedPoint& point) {
    json entry = {{"technique", point.technique}, {"baseline", point.is_baseline}, {"label", point.label}};
    if (!point.preset.empty()) entry["preset"] = point.preset;
    if (!point.parameters.empty()) entry["parameters"] = point.parameters;
    return entry;
}

json shots_of(const WatchSettings& settings, size_t scenes) {
    json shots = json::array();
    for (size_t i = 0; i < scenes; ++i) {
        json shot = {{"scene", settings.scenes[i]},
                     {"resolution", {settings.extent.x, settings.extent.y}},
                     {"frames", settings.frames},
                     {"measure", "last"}};
        if (!settings.camera.empty()) shot["camera"] = settings.camera;
        shots.push_back(std::move(shot));
    }
    return shots;
}

json study_of(const WatchSettings& settings, const std::vector<WatchedPoint>& points, size_t scenes) {
    json techniques = {{{"technique", "none"}, {"baseline", true}}};
    for (const WatchedPoint& point : points) techniques.push_back(entry_of(point));
    json study = {{"title", settings.name()}, {"shots", shots_of(settings, scenes)}, {"techniques", techniques}};
    if (settings.seeds > 0) study["seeds"] = settings.seeds;
    return study;
}

}  // namespace

PointName WatchedPoint::name() const {
    return {std::filesystem::path(technique).filename().string(), preset.empty() ? "default" : preset};
}

WatchedPoint point_against(const std::string& asked) {
    const std::string against = asked == "best" ? best_point : asked;
    const size_t colon = against.rfind(':');
    const bool has_preset = colon != std::string::npos && against.find('/', colon) == std::string::npos;
    WatchedPoint point{.technique = against.substr(0, has_preset ? colon : against.size()),
                       .preset = has_preset ? against.substr(colon + 1) : "",
                       .label = against};
    if (point.technique.find('/') != std::string::npos) {
        add_technique_folder(point.technique);
        point.technique = std::filesystem::absolute(point.technique).lexically_normal().string();
    }
    make_technique(point.name().first, json::object(), point.preset);  // says what is wrong with either
    return point;
}

json numbers_study(const WatchSettings& settings, const std::vector<WatchedPoint>& points, size_t scenes,
                   unsigned samples, bool is_whole) {
    json study = study_of(settings, points, scenes);
    study["reference"] = {{"samples", samples}};
    // The coarse truth is for mse alone, which no guide weighs. The usual guide of 64 samples would take about four
    // times as long as this truth.
    if (samples == coarse_samples && !is_whole) study["reference"]["guide_samples"] = coarse_samples;
    study["timing"] = {{"frames", 0}};
    study["targets"] = {"specular"};
    if (is_whole) {
        study["metrics"] = {"mse", "relmse", "flip"};
        return study;
    }
    study["metrics"] = {"mse"};
    study["masks"] = {"all", "reflective"};
    return study;
}

json why_study(const WatchSettings& settings, const WatchedPoint& point) {
    json study = numbers_study(settings, {point}, 1, settings.samples, false);
    study["techniques"].erase(0);  // no reflections, of which nothing is asked
    study["seeds"] = 1;
    study["hits"] = json::object();
    return study;
}

json times_study(const WatchSettings& settings, const std::vector<WatchedPoint>& points) {
    json study = numbers_study(settings, points, 1, settings.samples, false);
    study["techniques"].erase(0);
    study["seeds"] = 1;
    study["costs"] = true;
    study["gpu_compilers"] = {"navi21"};
    study["timing"] = {{"frames", 15}, {"most_share", 100}};
    return study;
}
