#pragma once
#include "core/variant.h"

#include <functional>
#include <span>

/// Named values of some parameters of a variant.
struct Preset {
    std::string name, meaning;
    nlohmann::json parameters;
};

/// The API that a technique keeps to, so that it runs there. `lifted_by` holds values of parameters; each of them asks
/// for more than the API has and lifts the limits.
struct VariantLimits {
    Limits api = Limits::none;
    nlohmann::json lifted_by = nlohmann::json::object();
};

/// One row of the table of techniques.
struct VariantEntry {
    std::string name, title, source, description;
    std::vector<std::string>
        needs;  ///< names of scene facts (core/gbuffer/scene_facts.h) without which it leaves stages out
    std::vector<Preset> presets;
    VariantLimits limits{};
    std::function<std::unique_ptr<Variant>()> create;
};

/// Parameter values with others changed or added: for presets that begin with another.
nlohmann::json changed(nlohmann::json parameters, const nlohmann::json& more);

/// All techniques, the baseline first. Adding one takes a line in registry.cpp and an entry in its own folder.
std::span<const VariantEntry> variant_table();

/// Fails with a near miss if there is none of that name.
const VariantEntry& find_variant(const std::string& name);

/// "WebGL 2 with EXT_color_buffer_float, unless hierarchy = mip_views"; "" where there are none.
std::string limits_text(const VariantLimits& limits);

/// The variant with its defaults, changed by the preset ("": none), changed by `parameters`; its limits are those of
/// the table, unless a parameter lifts them. Unknown names and values out of range are Errors that begin with the
/// variant's name.
std::unique_ptr<Variant> make_variant(const std::string& name,
                                      const nlohmann::json& parameters = nlohmann::json::object(),
                                      const std::string& preset = "");
