#include "experiments/results/verdicts/study_points.h"

#include "variants/registry.h"

#include <algorithm>

namespace {

using nlohmann::json;

struct RunPoint {
    std::string technique, point;
    json parameters;
};

std::vector<RunPoint> read_points(const json& manifest) {
    std::vector<RunPoint> points;
    const json techniques = manifest.value("techniques", json::array());
    for (const json& v : techniques)
        if (v.is_object() && v.contains("technique") && v["technique"].is_string() && v.contains("point") &&
            v["point"].is_string() && v.contains("parameters") && v["parameters"].is_object())
            points.push_back({v["technique"], v["point"], v["parameters"]});
    return points;
}

/// Those of the manifest's techniques for which `is_chosen(entry)`.
template <class IsChosen>
PointSet points_where(const json& manifest, IsChosen is_chosen) {
    PointSet points;
    for (const json& v : manifest.value("techniques", json::array()))
        if (v.is_object() && is_chosen(v)) points.insert({v.value("technique", ""), v.value("point", "")});
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
        if (!defaults.contains(p.technique) &&
            std::ranges::find(technique_table(), p.technique, &TechniqueEntry::name) != technique_table().end())
            defaults[p.technique] = make_technique(p.technique)->params.values();
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
    for (const json& v : manifest.value("techniques", json::array()))
        if (v.is_object() && v.contains("label") && v["label"].is_string())
            labels[{v.value("technique", ""), v.value("point", "")}] = v["label"];
    return labels;
}
