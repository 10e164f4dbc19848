#include "experiments/results/verdicts/study_points.h"

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

/// Those of the manifest's variants for which `is_chosen(entry)`.
template <class IsChosen>
PointSet points_where(const json& manifest, IsChosen is_chosen) {
    PointSet points;
    for (const json& v : manifest.value("variants", json::array()))
        if (v.is_object() && is_chosen(v)) points.insert({v.value("variant", ""), v.value("point", "")});
    return points;
}

}  // namespace

PrimaryComparisons primary_of(const nlohmann::json& manifest) {
    PrimaryComparisons primary;
    const nlohmann::json own = manifest.value("primary", nlohmann::json::object());
    primary.metric = own.value("metric", primary.metric), primary.mask = own.value("mask", primary.mask);
    primary.target = own.value("target", primary.target), primary.margin = own.value("margin", primary.margin);
    return primary;
}

PointSet single_changes(const json& manifest) {
    return points_where(manifest, [](const json& v) { return v.contains("single_change"); });
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
    return points_where(manifest,
                        [](const json& v) { return v.contains("depends_on_seed") && v["depends_on_seed"] == false; });
}

PointSet points_not_repeatable(const json& manifest) {
    return points_where(manifest, [](const json& v) { return v.contains("not_repeatable"); });
}

PointSet points_using_scene_data(const json& manifest) {
    return points_where(manifest, [](const json& v) { return v.value("uses_scene_data", false); });
}

std::map<std::pair<std::string, std::string>, std::string> point_labels(const json& manifest) {
    std::map<std::pair<std::string, std::string>, std::string> labels;
    for (const json& v : manifest.value("variants", json::array()))
        if (v.is_object() && v.contains("label") && v["label"].is_string())
            labels[{v.value("variant", ""), v.value("point", "")}] = v["label"];
    return labels;
}
