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

}  // namespace

PointSet single_changes(const json& manifest) {
    PointSet points;
    const json variants = manifest.value("variants", json::array());
    for (const json& v : variants)
        if (v.is_object() && v.contains("single_change")) points.insert({v.value("variant", ""), v.value("point", "")});
    return points;
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
