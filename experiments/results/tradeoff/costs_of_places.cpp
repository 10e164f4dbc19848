#include "experiments/results/tradeoff/costs_of_places.h"

#include "core/error.h"
#include "core/list_text.h"
#include "core/near_miss.h"
#include "experiments/results/files/manifest.h"
#include "experiments/results/verdicts/effects/over_scenes.h"

#include <algorithm>
#include <map>
#include <set>

namespace {

using nlohmann::json;

struct KindOfPlace {
    std::set<std::string> shots, sizes, assets;
    std::map<PointName, std::vector<const EstimateRow*>> totals;  ///< by point, one of each shot
};

std::map<std::string, KindOfPlace> kinds_of(const StudyResults& costs, const std::string& chip) {
    std::map<std::string, KindOfPlace> kinds;
    std::set<std::string> chips;
    for (const EstimateRow& e : costs.estimates) {
        chips.insert(e.chip);
        if (e.chip != chip || e.stage != "total") continue;
        const json& shot = shot_entry(costs.manifest, e.shot);
        KindOfPlace& kind = kinds[shot.value("group", "")];
        kind.shots.insert(e.shot), kind.assets.insert(asset_of(costs.manifest, e.shot));
        kind.sizes.insert(shot.at("width").dump() + "x" + shot.at("height").dump());
        kind.totals[{e.technique, e.point}].push_back(&e);
    }
    if (kinds.empty())
        fail("the study of costs has no estimate for '", shortened(chip), "'",
             chips.empty() ? std::string() : suggestion(chip, std::vector<std::string>(chips.begin(), chips.end())),
             "; its config names chips in \"gpu_compilers\", with \"costs\": true");
    return kinds;
}

/// The longest group that a shot's group begins with, as whole words.
const std::string& kind_of(const std::string& group, const std::map<std::string, KindOfPlace>& kinds,
                           const std::string& shot) {
    const std::string* longest = nullptr;
    for (const auto& [kind, places] : kinds) {
        const bool begins = group.starts_with(kind) && (kind.empty() || group.size() == kind.size() ||
                                                        group[kind.size()] == ',' || group[kind.size()] == ' ');
        if (begins && (!longest || kind.size() > longest->size())) longest = &kind;
    }
    if (!longest) {
        std::vector<std::string> known;
        for (const auto& [kind, places] : kinds) known.push_back("'" + kind + "'");
        fail("the study of costs has no place for ", shot, ", whose group is '", group, "'; its groups are ",
             joined(known));
    }
    return *longest;
}

/// A name may stand for other parameters in another study.
void require_same_points(const json& errors, const json& costs) {
    const std::map<PointName, json> known = parameters_of_points(costs);
    for (const auto& [point, own] : parameters_of_points(errors)) {
        const auto same = known.find(point);
        if (same == known.end()) continue;
        for (const auto& difference : json::diff(own, same->second))
            fail(point.first, " ", point.second, " has another ", difference.at("path").get<std::string>().substr(1),
                 " in the study of costs; run both studies with the same points");
    }
}

EstimateRow mean_of(const std::vector<const EstimateRow*>& totals, const json& manifest, double& half_width) {
    EstimateRow mean;
    const EstimateRow& first = *totals.front();
    mean.technique = first.technique, mean.point = first.point, mean.stage = first.stage;
    mean.chip = first.chip, mean.driver = first.driver, mean.product = first.product;
    std::vector<ShotValue> values;
    for (const EstimateRow* e : totals) {
        if (!e->microseconds) mean.refusal = e->refusal;
        if (e->driver != first.driver)
            fail("the study of costs has estimates of two drivers for ", e->chip, ": ", first.driver, " and ",
                 e->driver);
        values.push_back({asset_of(manifest, e->shot), e->microseconds.value_or(0)});
    }
    if (!mean.refusal.empty()) return mean;
    const MeanOverScenes over_places = mean_over_scenes(values);
    mean.microseconds = over_places.value;
    mean.low = over_places.low ? std::max(0.0, *over_places.low) : over_places.value;
    mean.high = over_places.high.value_or(over_places.value);
    if (over_places.value > 0) half_width = std::max(half_width, (*mean.high - *mean.low) / 2 / over_places.value);
    return mean;
}

}  // namespace

std::vector<CostsOfKind> take_costs_from(const StudyResults& costs, const std::string& chip, StudyResults& errors) {
    require_same_points(errors.manifest, costs.manifest);
    const std::map<std::string, KindOfPlace> kinds = kinds_of(costs, chip);
    std::map<std::string, std::vector<EstimateRow>> means;
    std::vector<CostsOfKind> found;
    for (const auto& [group, kind] : kinds) {
        CostsOfKind& costs_of = found.emplace_back(
            CostsOfKind{.group = group, .sizes = {kind.sizes.begin(), kind.sizes.end()}, .places = kind.assets.size()});
        for (const auto& [point, totals] : kind.totals) {
            if (totals.size() < kind.shots.size())
                fail("the study of costs is not complete: ", point.first, " ", point.second, " has ", totals.size(),
                     " of ", kind.shots.size(), " estimates", group.empty() ? "" : " of " + group);
            means[group].push_back(mean_of(totals, costs.manifest, costs_of.widest));
        }
    }
    std::erase_if(errors.estimates, [&](const EstimateRow& e) { return e.chip == chip; });
    for (const json& shot : errors.manifest.at("shots")) {
        const std::string name = shot.at("shot").get<std::string>();
        for (EstimateRow mean : means.at(kind_of(shot.value("group", ""), kinds, name))) {
            mean.shot = name;
            errors.estimates.push_back(std::move(mean));
        }
    }
    return found;
}
