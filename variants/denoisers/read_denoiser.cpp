#include "core/error.h"
#include "core/files.h"
#include "core/near_miss.h"
#include "core/own_files.h"
#include "core/path_inside.h"
#include "variants/common/names.h"
#include "variants/common/parameter_block.h"
#include "variants/denoisers/denoiser.h"
#include "variants/passes/read_passes.h"
#include "variants/passes/technique_files.h"

#include <algorithm>

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

std::string stage_of(const json& pass) {
    if (pass.contains("stage")) return pass["stage"];
    const std::string shader = (pass.contains("forms") ? pass["forms"].back() : pass).value("shader", "");
    const size_t begin = shader.rfind('/') + 1;
    return shader.substr(begin, shader.rfind('.') - begin);
}

/// Puts passes of the technique `technique` where a text names their stage, and the images, buffers and conditions that
/// they name beside those of the denoiser.
void take_passes(json& denoiser, const std::string& where) {
    const std::string technique = denoiser["technique"];
    json base = read_json_document(own_files() / "variants" / technique / "technique.json").value;
    write_out_short_forms(base);
    json passes = json::array();
    for (const json& pass : denoiser["passes"]) {
        if (!pass.is_string()) {
            passes.push_back(pass);
            continue;
        }
        const size_t before = passes.size();
        for (const json& one : base["passes"])
            if (pass == stage_of(one)) passes.push_back(one);
        if (passes.size() == before) fail(where, ": '", technique, "' has no pass ", shown(pass));
    }
    denoiser["passes"] = passes;
    const std::string named = passes.dump() + base.value("images", json::array()).dump();
    for (const char* key : {"conditions", "images", "buffers"}) {
        if (!base.contains(key)) continue;
        if (!denoiser.contains(key)) denoiser[key] = json::array();
        for (const json& one : base[key]) {
            const std::string name = one["name"];
            const bool is_given = std::ranges::count(denoiser_images, name) || std::ranges::count(ray_buffers, name);
            const bool is_used = passes.dump().find("\"" + name + "\"") != std::string::npos ||
                                 passes.dump().find("\"previous_" + name + "\"") != std::string::npos ||
                                 (key == std::string("conditions") && named.find("\"" + name + "\"") != named.npos);
            if (!is_given && is_used) denoiser[key].push_back(one);
        }
    }
}

}  // namespace

DenoiserEntry read_denoiser(const std::string& name) {
    const fs::path file = own_files() / "variants/denoisers" / name / "denoiser.json";
    JsonDocument document = read_json_document(file);
    if (document.value.contains("technique")) take_passes(document.value, file.string());
    write_out_short_forms(document.value);
    JsonObject root(document, file.string());
    know_keys(root, {"technique", "conditions", "images", "buffers", "random", "not_repeatable"});
    DenoiserEntry entry{.name = name};
    entry.title = root.text("title");
    entry.source = root.text("source");
    entry.description = root.text("description");
    entry.needs_density = root.boolean("needs_density", true);
    entry.takes_probe = root.boolean("takes_probe", true);
    entry.answers_rough_surfaces = root.boolean("answers_rough_surfaces", false);

    auto declaration = std::make_shared<Declaration>();
    declaration->name = "denoisers/" + name;
    declaration->is_denoiser = true;
    declaration->names_device = names_device(document.value);
    declaration->draws_random_numbers = Condition::never();
    ParameterReader reader;
    ParameterSet all;
    for (const DeclaredParameter& own : reader.read(root)) declaration->parameters.push_back(all.add(own.parameter));
    if (root.has("given")) {
        JsonObject given = root.object("given");
        for (const DeclaredParameter& one : reader.read(given)) entry.given.push_back(all.add(one.parameter));
        entry.is_given_as_technique = given.boolean("as_technique", false);
        if (given.has("values")) entry.given_values = given.any("values");
        given.finish();
    }
    read_passes(root, KnownValues(all), *declaration);
    root.finish();
    TechniqueFolder read{.path = file.parent_path(), .files = {}, .sources = {}, .content_hash = {}};
    for (DeclaredPass& pass : declaration->passes)  // of the root, not of the folder: no file is there twice
        for (DeclaredForm& form : pass.forms)
            if (form.shader.find('/') == std::string::npos) form.shader = declaration->name + "/" + form.shader;
    read_shaders(*declaration, read);

    ContentHash hash;
    hash.add(document.value.dump());
    for (const std::string& block : reader.of_ssrlab) hash.add(read_text(path_inside(own_files(), block)));
    entry.content_hash = hash.hex();
    entry.sources = read.sources;
    entry.passes = declaration;
    return entry;
}
