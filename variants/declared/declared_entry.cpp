#include "variants/declared/declared_entry.h"

#include "core/error.h"
#include "core/files.h"
#include "core/former_names.h"
#include "core/near_miss.h"
#include "core/own_files.h"
#include "core/path_inside.h"
#include "variants/common/names.h"
#include "variants/common/parameter_block.h"
#include "variants/common/plain_texts.h"
#include "variants/denoisers/denoisers.h"
#include "variants/passes/check_frames.h"
#include "variants/passes/read_passes.h"
#include "variants/passes/technique_files.h"

#include <algorithm>
#include <cctype>

namespace fs = std::filesystem;

namespace {

/// "linear_trace" of the slot "linear_tracer".
std::string function_of(const std::string& slot) {
    return slot.ends_with("tracer") ? slot.substr(0, slot.size() - 1) : slot + "_trace";
}

void read_tracers(JsonObject object, Declaration& declaration) {
    know_keys(object, {"slots", "after", "source", "defaults"});
    for (JsonObject& of_slot : object.objects("slots")) {
        know_keys(of_slot, {"name", "function", "default", "meaning"});
        TracerSlot slot{.name = variable_name(of_slot, "name"), .function = "", .initial = "", .doc = ""};
        slot.function = variable_name(of_slot, "function", function_of(slot.name));
        of_slot.any("default");
        slot.initial = of_slot.choice("default", names_of(tracer_table(), &TracerEntry::name), "");
        slot.doc = of_slot.text("meaning", "the march that finds what a ray meets");
        of_slot.finish();
        declaration.slots.push_back(slot);
    }
    if (declaration.slots.empty()) fail(object.at("slots"), ": 'slots' must name at least one tracer's place");
    if (object.has("after")) {
        const std::string name = object.choice("after", names_of(declaration.parameters, &Parameter::name),
                                               declaration.parameters.back().name);
        const auto found = std::ranges::find(declaration.parameters, name, &Parameter::name);
        declaration.parameters_before_tracers = size_t(found - declaration.parameters.begin()) + 1;
    }
    declaration.tracers_source = object.text("source", "");
    if (object.has("defaults")) declaration.tracer_defaults = object.any("defaults");
    object.finish();
    ParameterSet params;
    try {
        Tracers(params, declaration.slots, declaration.tracers_source, declaration.tracer_defaults);
    } catch (const Error& error) {
        fail(object.at("defaults"), ": ", error.what());
    }
}

void read_denoiser(JsonObject object, Declaration& declaration) {
    know_keys(object, {"default", "defaults"});
    const std::vector<std::string> names = names_of(denoiser_table(), &DenoiserEntry::name);
    object.any("default");
    DeclaredDenoiser denoiser{.initial = object.choice("default", names, ""), .place = object.where()};
    if (object.has("defaults")) denoiser.defaults = object.any("defaults");
    object.finish();
    declaration.denoiser = std::move(denoiser);
    try {
        make_declared(std::make_shared<Declaration>(declaration));
    } catch (const Error& error) {
        fail(object.at("defaults"), ": ", error.what());
    }
}

/// Fails if two of the parameters that shaders see have one name.
void refuse_repetition(const std::vector<DeclaredParameter>& declared, const Declaration& declaration) {
    const std::unique_ptr<Technique> technique = make_declared(std::make_shared<Declaration>(declaration));
    for (size_t i = 0; i < declared.size(); ++i) {
        const auto& [parameter, place] = declared[i];
        const std::string& name = parameter.name;
        if (name == "denoiser" && !declaration.denoiser)
            fail(place,
                 ": the parameter 'denoiser' chooses one of ssrlab's denoisers, which a technique with "
                 "\"denoiser\": {...} has; call yours otherwise");
        if (std::ranges::count(technique->params, parameter.glsl_name(), &Parameter::glsl_name) == 1) continue;
        const auto first = std::ranges::find(declaration.parameters, name, &Parameter::name);
        if (first - declaration.parameters.begin() < long(i))
            fail(place, ": the parameter '", name, "' is declared twice");
        if (std::ranges::count(declaration.parameters, name, &Parameter::name) == 1)
            fail(place, ": the parameter '", name,
                 "' is one that every such technique, its tracers or its denoiser have already; call yours otherwise");
    }
}

constexpr size_t most_parameters =
    500;  // each takes the compilers time; ssrlab's own have up to 327, tracers' included

/// `parameters`, `tracers` and `denoiser` of a technique.json.
void read_parameters(JsonObject& root, ParameterReader& reader, Declaration& declaration) {
    const std::vector<DeclaredParameter> declared = reader.read(root);
    if (declared.size() > most_parameters)
        fail(root.at("parameters"), ": there are ", declared.size(), " parameters, and a technique takes at most ",
             most_parameters);
    for (const DeclaredParameter& one : declared) declaration.parameters.push_back(one.parameter);
    declaration.parameters_before_tracers = declared.size();
    if (root.has("tracers")) read_tracers(root.object("tracers"), declaration);
    if (root.has("denoiser")) read_denoiser(root.object("denoiser"), declaration);
    refuse_repetition(declared, declaration);
}

/// `presets`: what points may start from. One may begin with another that stands before it.
std::vector<Preset> read_presets(JsonObject& root, const std::shared_ptr<const Declaration>& declaration) {
    std::vector<Preset> presets;
    for (JsonObject& object : root.objects("presets")) {
        know_keys(object, {"name", "description", "begins_with", "parameters"});
        Preset preset{object.text("name"), object.text("description"), nlohmann::json::object()};
        if (object.has("begins_with")) {
            const std::string first = object.text("begins_with");
            const auto found = std::ranges::find(presets, first, &Preset::name);
            if (found == presets.end())
                fail(object.at("begins_with"), ": there is no preset '", shortened(first), "' before this one",
                     suggestion(first, names_of(presets, &Preset::name)));
            preset.parameters = found->parameters;
        }
        if (!object.any("parameters").is_object())
            fail(object.at("parameters"), ": 'parameters' must be an object of values, not ",
                 shown(object.any("parameters")));
        preset.parameters.update(object.any("parameters"));
        if (std::ranges::find(presets, preset.name, &Preset::name) != presets.end())
            fail(object.at("name"), ": there are two presets '", shortened(preset.name), "'");
        try {
            make_declared(declaration)->params.assign(preset.parameters);
        } catch (const Error& error) {
            fail(object.at("parameters"), ": ", error.what());
        }
        object.finish();
        presets.push_back(std::move(preset));
    }
    return presets;
}

/// Of what can change a pixel.
std::string hash_of(nlohmann::json document, const TechniqueFolder& folder,
                    const std::vector<std::string>& parameter_blocks) {
    for (const char* text : {"title", "source", "description", "presets"}) document.erase(text);
    ContentHash hash;
    hash.add(document.dump());
    for (const auto& [name, text] : folder.files) hash.add(name), hash.add(text);
    for (const std::string& block : parameter_blocks) hash.add(read_text(path_inside(own_files(), block)));
    return hash.hex();
}

}  // namespace

fs::path whole_path(const fs::path& folder) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(fs::absolute(folder), error);
    return whole.has_filename() ? whole : whole.parent_path();
}

std::string declared_name(const fs::path& folder) {
    const std::string name = whole_path(folder).filename().string();
    const auto fits = [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '_'; };
    if (name.empty() || name.size() > 60 || !std::ranges::all_of(name, fits))
        fail("the folder ", folder.string(), " cannot name a technique: its name '", shortened(name),
             "' must be of small letters, digits and '_'");
    return name;
}

DeclaredEntry read_technique(const fs::path& named, bool checks_frames) {
    std::error_code error;
    const fs::path folder = whole_path(named);
    const fs::path file = path_inside(named.lexically_normal(), "technique.json");
    if (!fs::is_regular_file(file, error))
        fail("there is no technique in the folder ", named.string(),
             ": it has no technique.json; `ssrlab new FOLDER --from TECHNIQUE` writes one");
    JsonDocument document = read_json_document(file);
    require_plain_texts(document);
    take_former_names(document, FormerNames::of_technique);
    const nlohmann::json as_written = document.value;
    write_out_short_forms(document.value);
    JsonObject root(document, file.string());
    know_keys(root,
              {"title", "source", "description", "parameters", "tracers", "pyramids", "denoiser", "conditions",
               "images", "buffers", "passes", "result", "random", "not_repeatable", "reflects", "limits", "presets"});

    auto declaration = std::make_shared<Declaration>();
    declaration->name = declared_name(folder);
    declaration->names_device = names_device(document.value);
    if (const auto passes = document.value.find("passes"); passes != document.value.end() && passes->is_array())
        declaration->reads_inputs =
            !std::ranges::all_of(*passes, [](const auto& pass) { return pass.contains("clear"); });
    TechniqueEntry entry{.name = declaration->name,
                         .title = root.text("title"),
                         .source = root.text("source", ""),
                         .description = root.text("description", ""),
                         .presets = {},
                         .create = {}};
    ParameterReader reader(folder);
    read_parameters(root, reader, *declaration);
    const std::unique_ptr<Technique> plain = make_declared(std::make_shared<Declaration>(*declaration));
    read_passes(root, KnownValues(plain->params), *declaration);
    TechniqueFolder read{.path = folder, .files = {}, .sources = {}, .content_hash = {}};
    read_shaders(*declaration, read);
    if (checks_frames) check_frames(*declaration, plain->params);
    entry.limits = declaration->limits;
    entry.presets = read_presets(root, declaration);
    root.finish();

    for (const std::string& block : reader.of_folder) read.files[block] = read_text(path_inside(folder, block));
    read.content_hash = hash_of(as_written, read, reader.of_ssrlab);
    read.files["technique.json"] = read_text(file);
    entry.create = [declaration] { return make_declared(declaration); };
    entry.folder = std::make_shared<TechniqueFolder>(std::move(read));
    return {std::move(entry), declaration};
}

TechniqueEntry declared_entry(const fs::path& folder, bool checks_frames) {
    return read_technique(folder, checks_frames).entry;
}
