#pragma once
#include "variants/common/technique_entry.h"

#include <deque>
#include <filesystem>

/// All techniques, the baseline first, with the presets of their entries and those that `ssrlab tune` found; after them
/// those of add_technique_folder(). Adding one to ssrlab takes its folder and its name in registry.cpp.
const std::deque<TechniqueEntry>& technique_table();

/// Adds the technique that `folder`/technique.json declares (variants/declared), under the folder's name; of a folder
/// that is there already it reads the files again and replaces the entry, to which references stay valid. Not to be
/// called while another thread uses the table. Fails with Error, which names file and place, on what is wrong in it,
/// and if another technique has the name.
const TechniqueEntry& add_technique_folder(const std::filesystem::path& folder);

/// The name of the technique that a config or a command line calls `text`: what has a '/' is a folder, from `base`, and
/// is added.
std::string technique_name(const std::string& text, const std::filesystem::path& base = {});
/// The same of NAME:REST, as command lines choose points.
std::string technique_point_name(const std::string& text);

/// Adds presets that `ssrlab tune` found, from the presets.json that it wrote; the table has those of
/// variants/<name>/tuned_presets.json. An Error names the place of what is wrong in the file: presets of another
/// technique, or of a name that the entry has. Names and values of parameters are judged where a preset is used.
void add_tuned_presets(TechniqueEntry& entry, const std::filesystem::path& file);

/// Fails with a near miss if there is none of that name.
const TechniqueEntry& find_technique(const std::string& name);

/// Whether a technique whose parameters have these values reads its parameter `name`: not if that is of a tracer or a
/// denoiser that it has not chosen.
bool is_read(const ParameterSet& params, const std::string& name);

/// "WebGL 2 with EXT_color_buffer_float, unless hierarchy = mip_views"; "" where there are none.
std::string limits_text(const TechniqueLimits& limits);

/// The technique with its defaults, changed by the preset ("": none), changed by `parameters`; its limits are those of
/// the table, unless a parameter lifts them. Unknown names and values out of range are Errors that begin with the
/// technique's name.
std::unique_ptr<Technique> make_technique(const std::string& name,
                                          const nlohmann::json& parameters = nlohmann::json::object(),
                                          const std::string& preset = "");
