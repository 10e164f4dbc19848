#pragma once
#include "core/variant.h"

#include <functional>
#include <span>

/// Named values of some parameters of a variant.
struct Preset {
    std::string name, meaning;
    nlohmann::json parameters;
};

/// One row of the table of techniques.
struct VariantEntry {
    std::string name, title, source, description;
    std::vector<std::string>
        needs;  ///< names of scene facts (core/gbuffer/scene_facts.h) without which it leaves stages out
    std::vector<Preset> presets;
    std::function<std::unique_ptr<Variant>()> create;
};

/// All techniques, the baseline first.
std::span<const VariantEntry> variant_table();

/// Fails with a near miss if there is none of that name.
const VariantEntry& find_variant(const std::string& name);

/// The variant with its defaults, changed by the preset ("": none), changed by `parameters`. Unknown names and values
/// out of range are Errors that begin with the variant's name.
std::unique_ptr<Variant> make_variant(const std::string& name,
                                      const nlohmann::json& parameters = nlohmann::json::object(),
                                      const std::string& preset = "");
