#pragma once
#include "variants/common/variant_entry.h"

#include <span>

/// All techniques, the baseline first. Adding one takes a declaration and a line in registry.cpp, and an entry in its
/// own folder.
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
