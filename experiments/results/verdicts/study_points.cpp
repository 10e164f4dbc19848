#include "experiments/results/verdicts/study_points.h"

#include "experiments/results/files/manifest.h"
#include "variants/registry.h"

#include <algorithm>

namespace {

using nlohmann::json;

/// Those of the manifest's techniques for which `is_chosen(entry)`.
template <class IsChosen>
PointSet points_where(const json& manifest, IsChosen is_chosen) {
    PointSet points;
    for (const json& v : manifest.value("techniques", json::array()))
        if (is_chosen(v)) points.insert({v.value("technique", ""), v.value("point", "")});
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
    for (const auto& [name, parameters] : parameters_of_points(manifest))
        if (!defaults.contains(name.first) &&
            std::ranges::find(technique_table(), name.first, &TechniqueEntry::name) != technique_table().end())
            defaults[name.first] = make_technique(name.first)->params.values();
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
