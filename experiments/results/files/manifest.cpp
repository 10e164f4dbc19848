#include "experiments/results/files/manifest.h"

#include "metrics/temporal.h"

#include <algorithm>

namespace {

const char* name_of(Better better) {
    switch (better) {
        case Better::lower:
            return "lower";
        case Better::higher:
            return "higher";
        case Better::near_zero:
            return "near_zero";
        case Better::near_one:
            return "near_one";
    }
    return "";
}

}  // namespace

nlohmann::json metric_descriptions() {
    nlohmann::json all = nlohmann::json::object();
    const auto describe = [&](const auto& m) {
        all[m.name] = {{"formula", m.formula}, {"unit", m.unit}, {"better", name_of(m.better)}, {"doc", m.doc}};
    };
    for (const Metric& m : all_metrics()) describe(m);
    for (const TemporalMetric& m : temporal_metrics()) describe(m);
    for (const auto& [name, doc] : {std::pair("bias_squared", "what of the squared error all seeds share"),
                                    std::pair("variance", "what of the squared error differs from seed to seed")})
        all[name] = {
            {"formula", "seed_pairs"}, {"unit", "radiance^2"}, {"better", name_of(Better::lower)}, {"doc", doc}};
    return all;
}

std::optional<double> aa_floor(const nlohmann::json& manifest, const std::string& shot) {
    const nlohmann::json::json_pointer place("/clock/aa_floors");
    if (!manifest.contains(place) || !manifest[place].is_object()) return {};
    const auto found = manifest[place].find(shot);
    return found == manifest[place].end() || !found->is_number() ? std::nullopt : std::optional(found->get<double>());
}

size_t aa_pair_count(const nlohmann::json& manifest, const std::string& shot) {
    const nlohmann::json none = nlohmann::json::object();
    const nlohmann::json pairs = manifest.value("clock", none).value("aa_pairs", nlohmann::json::array());
    return size_t(std::ranges::count_if(pairs, [&](const nlohmann::json& p) { return p.value("shot", "") == shot; }));
}
