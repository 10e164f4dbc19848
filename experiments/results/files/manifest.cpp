#include "experiments/results/files/manifest.h"

#include "metrics/temporal.h"

#include <algorithm>

namespace {

const char* name_of(Better better) {
    constexpr const char* names[] = {"lower", "higher", "near_zero", "near_one"};  // in the order of Better
    return names[size_t(better)];
}

}  // namespace

nlohmann::json metric_descriptions() {
    nlohmann::json all = nlohmann::json::object();
    const auto describe = [&](const auto& m) {
        all[m.name] = {{"formula", m.formula}, {"unit", m.unit}, {"better", name_of(m.better)}, {"doc", m.doc}};
    };
    for (const Metric& m : all_metrics()) describe(m);
    for (const TemporalMetric& m : temporal_metrics()) describe(m);
    for (const auto& [name, doc] : {std::pair("bias_squared", "Part of the squared error that all seeds share"),
                                    std::pair("variance", "Part of the squared error that differs from seed to seed")})
        all[name] = {
            {"formula", "seed_pairs"}, {"unit", "radiance^2"}, {"better", name_of(Better::lower)}, {"doc", doc}};
    return all;
}

const nlohmann::json& member(const nlohmann::json& object, const char* key) {
    static const nlohmann::json none;
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

namespace {

bool is_text(const nlohmann::json& value, const std::string& text) {
    return value.is_string() && value.get_ref<const std::string&>() == text;
}

}  // namespace

const nlohmann::json& shot_entry(const nlohmann::json& manifest, const std::string& shot) {
    static const nlohmann::json none = nlohmann::json::object();
    for (const nlohmann::json& entry : member(manifest, "shots"))
        if (is_text(member(entry, "shot"), shot)) return entry;
    return none;
}

std::string asset_of(const nlohmann::json& manifest, const std::string& shot) {
    for (const char* key : {"asset", "scene"})
        if (const std::string name = shot_entry(manifest, shot).value(key, ""); !name.empty()) return name;
    return shot;
}

std::vector<Rung> truth_ladder(const nlohmann::json& manifest, const std::string& shot,
                               const PrimaryComparisons& error) {
    std::vector<Rung> rungs;
    for (const nlohmann::json& rung : member(shot_entry(manifest, shot), "truth_ladder")) {
        const auto number = [&](const char* key) {
            const nlohmann::json value = rung.value(key, nlohmann::json());
            return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
        };
        const auto value = number("value");
        if (value && rung.value("target", "") == error.target && rung.value("metric", "") == error.metric &&
            rung.value("mask", "") == error.mask)
            rungs.push_back({rung.value("rung", ""), *value, number("low"), number("high")});
    }
    return rungs;
}

bool is_clock_proven(const nlohmann::json& manifest, const std::string& shot) {
    bool is_proven = false;
    for (const nlohmann::json& proof : member(member(manifest, "clock"), "proofs"))
        if (std::ranges::any_of(member(proof, "shots"), [&](const auto& timed) { return is_text(timed, shot); }))
            is_proven = is_text(member(proof, "verdict"), "passed");
    return is_proven;
}

std::map<PointName, nlohmann::json> parameters_of_points(const nlohmann::json& manifest) {
    std::map<PointName, nlohmann::json> parameters;
    for (const nlohmann::json& v : manifest.value("techniques", nlohmann::json::array()))
        parameters[{v.value("technique", ""), v.value("point", "")}] = v.value("parameters", nlohmann::json::object());
    return parameters;
}

std::map<PointName, std::string> point_labels(const nlohmann::json& manifest) {
    std::map<PointName, std::string> labels;
    for (const nlohmann::json& v : manifest.value("techniques", nlohmann::json::array()))
        if (const std::string label = v.value("label", ""); !label.empty())
            labels[{v.value("technique", ""), v.value("point", "")}] = label;
    return labels;
}

std::optional<double> aa_floor(const nlohmann::json& manifest, const std::string& shot) {
    const nlohmann::json::json_pointer place("/clock/aa_floors");
    if (!manifest.contains(place) || !manifest[place].is_object()) return {};
    const auto found = manifest[place].find(shot);
    return found == manifest[place].end() || !found->is_number() ? std::nullopt : std::optional(found->get<double>());
}

size_t aa_pair_count(const nlohmann::json& manifest, const std::string& shot) {
    return size_t(std::ranges::count_if(member(member(manifest, "clock"), "aa_pairs"),
                                        [&](const nlohmann::json& p) { return is_text(member(p, "shot"), shot); }));
}
