#include "experiments/study/config/points/conditions.h"

#include "core/value_condition.h"
#include "experiments/study/config/points/external_images.h"
#include "experiments/study/config/shots/read_shots.h"
#include "variants/common/condition.h"

#include <algorithm>

namespace {

using nlohmann::json;

const std::string shot_prefix = "shot.";

json values_of(const Shot& shot) {
    json values = facts_by_name(shot.facts);
    values.update({{"shot.scene", shot.scene.name},
                   {"shot.camera", shot.camera.name},
                   {"shot.width", shot.config.extent.x},
                   {"shot.height", shot.config.extent.y},
                   {"shot.frames", shot.config.frames.size()}});
    const json settings = shot_settings(shot.config);
    for (const auto& [setting, word] : settings.items()) values[shot_prefix + setting] = word;
    return values;
}

std::string text_of(const PointCondition& condition) {
    return (condition.skips ? "skip_if " : "only_if ") + condition.tests.dump();
}

}  // namespace

Keys condition_keys() {
    const Values tests = {{{"type", "object"}}, "an object of conditions", {}};
    return {{"only_if", tests, otherwise("everywhere"), "Include only where all these conditions hold"},
            {"skip_if", tests, otherwise("nowhere"), "Leave out where all these conditions hold"}};
}

std::vector<PointCondition> read_conditions(ConfigObject& entry, const ParameterSet& declared) {
    if (!entry.has("only_if") && !entry.has("skip_if")) return {};
    json samples = values_of(Shot{});
    samples.update(declared.values());
    std::vector<PointCondition> conditions;
    for (const char* key : {"only_if", "skip_if"}) {
        if (!entry.has(key)) continue;
        check_conditions(entry[key], samples, entry.plain(key));
        conditions.push_back({.skips = key == std::string("skip_if"), .tests = entry[key]});
    }
    return conditions;
}

bool is_wanted(std::vector<PointCondition>& conditions, const json& parameters) {
    std::vector<PointCondition> left;
    for (PointCondition& condition : conditions) {
        bool all_hold = true;
        json of_shots = json::object();
        for (const auto& [name, test] : condition.tests.items()) {
            if (name.starts_with(shot_prefix))
                of_shots[name] = test;
            else
                all_hold &= holds(test, parameters.at(name));
        }
        if (condition.skips && !all_hold) continue;
        if (!condition.skips && !all_hold) return false;
        if (of_shots.empty() && condition.skips) return false;
        if (!of_shots.empty()) left.push_back({condition.skips, std::move(of_shots)});
    }
    conditions = std::move(left);
    return true;
}

std::string why_skipped(const PointConfig& technique, const Shot& shot) {
    if (!technique.how_it_ended.empty()) return technique.how_it_ended;
    if (technique.external) {
        if (const std::string why = why_not_external(shot); !why.empty()) return why;
        if (!technique.external->has_view(shot))
            return technique.external->folder.string() + " holds no " + ExternalImages::view_name(shot);
    }
    if (technique.conditions.empty()) return "";
    const json values = values_of(shot);
    for (const PointCondition& condition : technique.conditions)
        if (all_hold(condition.tests, values) == condition.skips) return text_of(condition);
    return "";
}

bool runs_on(const PointConfig& technique, const Shot& shot) { return why_skipped(technique, shot).empty(); }

Config config_on(const Config& study, const Shot& shot) {
    Config config = study;
    std::erase_if(config.techniques, [&](const PointConfig& technique) { return !runs_on(technique, shot); });
    return config;
}
