#pragma once
#include "core/json.h"

#include <string>

// ssrlab reads former names of keys, options and files. A note on the terminal says each present name once.

enum class FormerNames { of_study, of_technique };

/// Renames keys, and texts that name columns. In a study's config or cell, and in tuned presets, `variant` becomes
/// `technique` and `resolve` becomes `denoiser`; in a technique.json only `resolve` changes. `shots` is left alone.
/// JsonDocument::places change likewise.
void take_former_names(JsonDocument& document, FormerNames which);

/// The present path of one of ssrlab's shaders or blocks of parameters: "denoisers/ray.glsl" for "resolves/ray.glsl".
std::string present_path(std::string path);

/// The present name of a technique's preset: "corrected" for "repaired" of composed_ssr.
std::string present_preset(const std::string& technique, const std::string& preset);

/// The present form of a command's word: "--techniques" for "--variants", and after `--cells` "technique=none" for
/// "variant=none". `before`: the words before it.
std::string present_word(const std::string& word, const std::vector<std::string>& before);
