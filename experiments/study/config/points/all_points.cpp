#include "experiments/study/config/points/all_points.h"

#include "experiments/study/config/chosen.h"
#include "experiments/study/config/points/point_name.h"
#include "variants/registry.h"
#include "variants/tracers/tracers.h"

PointConfig single_point(const std::string& technique, const std::string& preset, const nlohmann::json& parameters) {
    return {.technique = technique_name(technique),
            .preset = preset,
            .parameters = parameters,
            .point = point_name(preset, parameters),
            .seeds = {1},
            .against = {},
            .against_point = {}};
}

std::vector<std::string> names_of_point(const PointConfig& point) {
    return {point.technique, point.technique + ":" + point.point};
}

std::vector<PointConfig> all_points(const std::vector<std::string>& names) {
    std::vector<std::string> wanted;
    for (const std::string& name : names) wanted.push_back(technique_point_name(name));
    std::vector<PointConfig> points;
    for (const TechniqueEntry& entry : technique_table()) {
        if (entry.presets.empty() || !entry.is_ssrlabs() || entry.name == "mcguire_dda" || entry.name == "composed_ssr")
            points.push_back(single_point(entry.name));
        for (const Preset& preset : entry.presets) points.push_back(single_point(entry.name, preset.name));
        if (entry.name != "mcguire_dda") continue;
        for (const TracerEntry& tracer : tracer_table())
            if (tracer.name != "exact_scene" && tracer.name != "dda")
                points.push_back(single_point(entry.name, "", {{"tracer", tracer.name}}));
    }
    return chosen(points, wanted, "technique", names_of_point);
}
