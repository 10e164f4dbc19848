#pragma once
#include "core/json.h"

#include <string>

// Names that keys, options and files had go on being read: a note on the terminal says the name that each has, once.

enum class FormerNames { of_study, of_technique };

/// Renames keys, and texts that name columns, of a study's config or cell, or of tuned presets: `variant` is
/// `technique`, `resolve` is `denoiser`; of a technique.json the latter alone. `shots` is left alone. Places move
/// along.
void take_former_names(JsonDocument& document, FormerNames which);

/// The path of one of ssrlab's own shaders or blocks of parameters: "resolves/ray.glsl" is "denoisers/ray.glsl".
std::string present_path(std::string path);

/// The preset of a technique as it is: "repaired" of composed_ssr is "corrected".
std::string present_preset(const std::string& technique, const std::string& preset);

/// A command's word as it is: "--variants" is "--techniques", and after `--cells` "variant=none" is "technique=none".
/// `before`: the words before it.
std::string present_word(const std::string& word, const std::vector<std::string>& before);
