#pragma once
#include "variants/common/technique_entry.h"

#include <deque>
#include <filesystem>

/// All techniques, the baseline first, with their own presets and those that `ssrlab tune` found; then those of
/// add_technique_folder(). A new technique of ssrlab needs a folder, and its name in registry.cpp.
const std::deque<TechniqueEntry>& technique_table();

/// Adds the technique that `folder`/technique.json declares (variants/declared), under the folder's name; A folder that
/// was added before is read again and replaces its entry; references to the entry stay valid. Do not call it while
/// another thread uses the table. Fails with Error, which names file and place, if something is wrong, or if another
/// technique has the name.
const TechniqueEntry& add_technique_folder(const std::filesystem::path& folder);

/// The name of the technique that a config or a command line calls `text`. A text with '/' is a folder, relative to
/// `base`, which is added.
std::string technique_name(const std::string& text, const std::filesystem::path& base = {});
/// The same for NAME:REST, by which command lines choose points.
std::string technique_point_name(const std::string& text);

/// Adds presets from a presets.json that `ssrlab tune` wrote; the table already has those of
/// variants/<name>/tuned_presets.json. Fails with Error, which names the place, on presets of another technique, or of
/// a name that the entry has. Names and values of parameters are checked when a preset is used.
void add_tuned_presets(TechniqueEntry& entry, const std::filesystem::path& file);

/// Fails if `name` is no technique and a folder with one: folders are named with a '/'.
void refuse_folder_without_dot(const std::string& name);

/// Fails with a near miss if there is none of that name, or as refuse_folder_without_dot().
const TechniqueEntry& find_technique(const std::string& name);

/// Whether a technique with these values reads its parameter `name`: not if `name` belongs to a tracer or denoiser that
/// the technique has not chosen.
bool is_read(const ParameterSet& params, const std::string& name);

/// "WebGL 2 with EXT_color_buffer_float, unless hierarchy = mip_views"; "" without limits.
std::string limits_text(const TechniqueLimits& limits);

/// The technique with its defaults, changed by the preset ("": none), then by `parameters`. Its limits are those of the
/// table, unless a parameter lifts them. Unknown names and values out of range are Errors that begin with the
/// technique's name.
std::unique_ptr<Technique> make_technique(const std::string& name,
                                          const nlohmann::json& parameters = nlohmann::json::object(),
                                          const std::string& preset = "");
