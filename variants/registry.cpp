#include "variants/registry.h"

#include "core/error.h"
#include "core/former_names.h"
#include "core/gpu/pipelines/shader_files.h"
#include "core/json.h"
#include "core/near_miss.h"
#include "core/own_files.h"
#include "core/path_inside.h"
#include "variants/denoisers/denoisers.h"
#include "variants/tracers/tracers.h"

/// Of variants/declared, which the cells of points name among their sources: those of references do not depend on it.
TechniqueEntry declared_entry(const std::filesystem::path& folder, bool checks_frames = true);

namespace {

/// variants/<name>/technique.json.
TechniqueEntry own_declared_entry(const std::string& name) {
    TechniqueEntry entry = declared_entry(own_files() / "variants" / name, false);
    TechniqueFolder folder = *entry.folder;
    folder.is_ssrlabs = true;
    entry.folder = std::make_shared<TechniqueFolder>(std::move(folder));
    return entry;
}

/// In the order of lists and reports.
std::deque<TechniqueEntry> entries_with_tuned_presets() {
    std::deque<TechniqueEntry> entries;
    for (const char* name : {"none", "mcguire_dda", "amd_sssr", "diligent_ssr", "frostbite_sssr", "simple_ssr",
                             "four_mode_ssr", "composed_ssr"})
        entries.push_back(own_declared_entry(name));
    for (TechniqueEntry& entry : entries) {
        const auto file = own_files() / "variants" / entry.name / "tuned_presets.json";
        if (std::filesystem::exists(file)) add_tuned_presets(entry, file);
    }
    return entries;
}

std::deque<TechniqueEntry>& growing_table() {
    static std::deque<TechniqueEntry> table = entries_with_tuned_presets();
    return table;
}

}  // namespace

const std::deque<TechniqueEntry>& technique_table() { return growing_table(); }

const TechniqueEntry& add_technique_folder(const std::filesystem::path& folder) {
    TechniqueEntry entry = declared_entry(folder);
    const auto known = std::ranges::find(growing_table(), entry.name, &TechniqueEntry::name);
    const bool is_new = known == growing_table().end();
    if (!is_new && known->is_ssrlabs())
        fail(folder.string(), ": '", entry.name, "' is one of ssrlab's own techniques; give the folder another name");
    if (!is_new && known->folder->path != entry.folder->path)
        fail(folder.string(), ": ", known->folder->path.string(), " is called '", entry.name,
             "', too; give one of them another name");
    if (const auto tuned = path_inside(entry.folder->path, "tuned_presets.json"); std::filesystem::exists(tuned))
        add_tuned_presets(entry, tuned);
    set_shader_folder(entry.name, entry.folder->files);
    return is_new ? growing_table().emplace_back(std::move(entry)) : *known = std::move(entry);
}

std::string technique_name(const std::string& text, const std::filesystem::path& base) {
    if (text.find('/') == std::string::npos) return text;
    return add_technique_folder(base / text).name;
}

std::string technique_point_name(const std::string& text) {
    const size_t slash = text.rfind('/'), colon = slash == std::string::npos ? slash : text.find(':', slash);
    if (colon == std::string::npos) return technique_name(text);
    return technique_name(text.substr(0, colon)) + text.substr(colon);
}

void add_tuned_presets(TechniqueEntry& entry, const std::filesystem::path& file) {
    JsonDocument document = read_json_document(file);
    take_former_names(document, FormerNames::of_study);
    JsonObject root(document, file.string());
    for (JsonObject& found : root.objects("presets")) {
        const std::string of = found.text("technique");
        if (of != entry.name) fail(found.at("technique"), ": '", of, "' is not '", entry.name, "'");
        const Preset preset{found.text("name"), found.text("description"), found.any("parameters")};
        if (std::ranges::find(entry.presets, preset.name, &Preset::name) != entry.presets.end())
            fail(found.at("name"), ": '", entry.name, "' has a preset '", preset.name, "' already");
        found.finish();
        entry.presets.push_back(preset);
    }
    root.finish();
}

namespace {

bool are_lifted(const TechniqueLimits& limits, const nlohmann::json& parameters) {
    for (const auto& [name, value] : limits.lifted_by.items())
        if (parameters.at(name) == value) return true;
    return false;
}

}  // namespace

void refuse_folder_without_dot(const std::string& name) {
    std::error_code error;
    if (std::filesystem::is_regular_file(std::filesystem::path(name) / "technique.json", error) &&
        !std::ranges::count(technique_table(), name, &TechniqueEntry::name))
        fail("unknown technique '", name, "'; for the folder of this name write ./", name);
}

const TechniqueEntry& find_technique(const std::string& name) {
    refuse_folder_without_dot(name);
    return find_named(technique_table(), name, "unknown technique");
}

bool is_read(const ParameterSet& params, const std::string& name) {
    return is_of_chosen_tracer(params, name) && is_of_chosen_denoiser(params, name);
}

std::string limits_text(const TechniqueLimits& limits) {
    std::string text = name_of(limits.api);
    for (const auto& [name, value] : limits.lifted_by.items())
        text += ", unless " + name + " = " + (value.is_string() ? value.get<std::string>() : value.dump());
    if (limits.api != Limits::none) text += ", unless scene data answers rays";
    return text;
}

std::unique_ptr<Technique> make_technique(const std::string& name, const nlohmann::json& parameters,
                                          const std::string& preset) {
    const TechniqueEntry& entry = find_technique(name);
    std::unique_ptr<Technique> technique = entry.create();
    if (!preset.empty()) {
        const std::string what = "unknown preset of technique '" + name + "':";
        technique->params.assign(find_named(entry.presets, present_preset(name, preset), what).parameters);
    }
    try {
        if (!parameters.is_null()) technique->params.assign(parameters);
    } catch (const Error& error) {
        fail("technique '", name, "': ", error.what());
    }
    const bool is_free = technique->uses_scene_data() || are_lifted(entry.limits, technique->params.values());
    technique->limits = is_free ? Limits::none : entry.limits.api;
    return technique;
}
