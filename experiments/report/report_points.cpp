#include "experiments/report/report_points.h"

#include "variants/registry.h"

#include <algorithm>

namespace {

using nlohmann::json;

struct RunPoint {
    std::string variant, point;
    json parameters;
};

std::vector<RunPoint> read_points(const json& manifest) {
    std::vector<RunPoint> points;
    const json variants = manifest.value("variants", json::array());
    for (const json& v : variants)
        if (v.is_object() && v.contains("variant") && v["variant"].is_string() && v.contains("point") &&
            v["point"].is_string() && v.contains("parameters") && v["parameters"].is_object())
            points.push_back({v["variant"], v["point"], v["parameters"]});
    return points;
}

std::vector<std::string> differing_parameters(const json& a, const json& b) {
    std::vector<std::string> names;
    for (const auto& [name, value] : a.items())
        if (!b.contains(name) || b[name] != value) names.push_back(name);
    return names;
}

}  // namespace

std::vector<SingleChange> single_changes(const json& manifest, std::span<const EffectRow> effects) {
    PointSet baselines;
    for (const EffectRow& e : effects)
        if (e.against == baseline_name) baselines.insert({e.against_variant, e.against_point});
    const std::vector<RunPoint> points = read_points(manifest);
    std::vector<SingleChange> changes;
    for (const RunPoint& p : points) {
        const bool is_swept = p.point.find('=') != std::string::npos;  // else a preset, which is compared as a whole
        if (!is_swept || baselines.contains({p.variant, p.point})) continue;
        for (const RunPoint& baseline : points) {
            if (baseline.variant != p.variant || !baselines.contains({baseline.variant, baseline.point})) continue;
            const std::vector<std::string> names = differing_parameters(p.parameters, baseline.parameters);
            if (names.size() != 1) continue;
            changes.push_back({p.variant, p.point, names.front(), p.parameters[names.front()]});
            break;
        }
    }
    return changes;
}

json parameter_defaults(const json& manifest) {
    json defaults = json::object();
    for (const RunPoint& p : read_points(manifest))
        if (!defaults.contains(p.variant) &&
            std::ranges::find(variant_table(), p.variant, &VariantEntry::name) != variant_table().end())
            defaults[p.variant] = make_variant(p.variant)->params.values();
    return defaults;
}

PointSet points_without_seeds(const json& manifest) {
    PointSet points;
    const json variants = manifest.value("variants", json::array());
    for (const json& v : variants)
        if (v.is_object() && v.contains("depends_on_seed") && v["depends_on_seed"] == false)
            points.insert({v.value("variant", ""), v.value("point", "")});
    return points;
}

PointSet points_not_repeatable(const json& manifest) {
    PointSet points;
    const json variants = manifest.value("variants", json::array());
    for (const json& v : variants)
        if (v.is_object() && v.contains("not_repeatable"))
            points.insert({v.value("variant", ""), v.value("point", "")});
    return points;
}

PointSet points_of(std::span<const SingleChange> changes) {
    PointSet points;
    for (const SingleChange& c : changes) points.insert({c.variant, c.point});
    return points;
}
