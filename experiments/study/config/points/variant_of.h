#pragma once
#include "experiments/study/config/config.h"
#include "variants/variant.h"

#include <memory>

/// The technique of a point, with the point's values; of external images one without parameters, which cannot render.
std::unique_ptr<Variant> variant_of(const VariantConfig& point);

/// With other values in place of the point's own.
std::unique_ptr<Variant> variant_of(const VariantConfig& point, const nlohmann::json& parameters);

/// The same technique with its defaults.
std::unique_ptr<Variant> plain_variant_of(const VariantConfig& point);
