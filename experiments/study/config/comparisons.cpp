#include "experiments/study/config/comparisons.h"

#include "core/error.h"
#include "core/json.h"
#include "experiments/study/config/points/point_name.h"
#include "experiments/study/config/points/technique_of.h"

#include <algorithm>
#include <map>
#include <utility>

namespace {

/// Of all parameters, with some values in place of the point's own.
nlohmann::json values_of(const PointConfig& v, const nlohmann::json& changed = nlohmann::json::object()) {
    nlohmann::json parameters = v.parameters;
    parameters.update(changed);
    return technique_of(v, parameters)->params.values();
}

}  // namespace

void find_against_points(std::vector<PointConfig>& techniques, const std::string& where) {
    if (std::ranges::all_of(techniques, [](const PointConfig& v) { return v.against.is_null(); })) return;
    std::map<std::pair<std::string, nlohmann::json>, std::string>
        points;  // by technique and the values of all parameters
    for (const PointConfig& v : techniques) points.try_emplace({v.technique, values_of(v)}, v.point);
    for (PointConfig& v : techniques) {
        if (v.against.is_null()) continue;
        const nlohmann::json other = values_of(v, v.against);
        if (other == values_of(v)) continue;
        const auto found = points.find({v.technique, other});
        if (found == points.end())
            fail(where, ": techniques: the 'against' of '", v.technique, "' with the point '", v.point,
                 "' needs a point that differs in ", shown(v.against), " alone; add that point");
        v.against_point = found->second;
    }
}

std::vector<ComparedPoint> compared_points(const std::vector<PointConfig>& techniques) {
    std::vector<ComparedPoint> points;
    for (const PointConfig& v : techniques)
        points.push_back({.technique = v.technique,
                          .point = v.point,
                          .depends_on_seed = v.depends_on_seed,
                          .is_baseline = v.is_baseline,
                          .against = v.against_point.empty() ? "" : label_of(v.against),
                          .against_point = v.against_point});
    return points;
}

std::vector<SingleChange> single_changes(const std::vector<PointConfig>& techniques) {
    std::vector<SingleChange> changes;
    std::vector<std::pair<std::string, nlohmann::json>> baselines;  // techniques and values
    for (const PointConfig& v : techniques)
        if (v.is_baseline) baselines.emplace_back(v.technique, values_of(v));
    for (const PointConfig& v : techniques) {
        if (v.is_baseline || v.swept.empty()) continue;  // a preset is compared as a whole
        const nlohmann::json own = values_of(v);
        for (const auto& [technique, other] : baselines) {
            if (technique != v.technique) continue;
            std::vector<std::string> differing;
            for (const auto& [name, value] : own.items())
                if (other.at(name) != value) differing.push_back(name);
            if (differing.size() != 1) continue;
            changes.push_back({v.technique, v.point, differing.front(), own.at(differing.front())});
            break;
        }
    }
    return changes;
}
