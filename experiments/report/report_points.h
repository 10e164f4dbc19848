#pragma once
#include "experiments/results/effects.h"
#include "experiments/results/summary.h"

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// A swept point that differs from a baseline of its variant in one parameter. A study may hold dozens: they belong
/// into the list of effects, not into every table and chart.
struct SingleChange {
    std::string variant, point, parameter;
    nlohmann::json value;
};

/// In the order of manifest.json's `variants`; the baselines are those that `effects` compares with. Manifests of other
/// versions may lack any key: what is not known to be a single change is none.
std::vector<SingleChange> single_changes(const nlohmann::json& manifest, std::span<const EffectRow> effects);

/// {variant: {parameter: default}} of the manifest's variants, as this build has them; those that it does not know are
/// left out.
nlohmann::json parameter_defaults(const nlohmann::json& manifest);

/// Points that do not depend on seeds, as the manifest has them. Those of which it does not tell are none of them.
PointSet points_without_seeds(const nlohmann::json& manifest);

/// Points whose results differ from run to run.
PointSet points_not_repeatable(const nlohmann::json& manifest);

PointSet points_of(std::span<const SingleChange> changes);
