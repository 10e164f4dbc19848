#include "variants/declared/declared_entry.h"

#include "core/error.h"
#include "core/files.h"
#include "core/near_miss.h"
#include "core/path_inside.h"
#include "variants/declared/check_frames.h"
#include "variants/declared/names.h"
#include "variants/declared/read_parameters.h"
#include "variants/declared/read_passes.h"
#include "variants/declared/technique_files.h"

#include <algorithm>
#include <cctype>

namespace fs = std::filesystem;

namespace {

/// `presets`: what points may start from.
std::vector<Preset> read_presets(JsonObject& root, const std::shared_ptr<const Technique>& technique) {
    std::vector<Preset> presets;
    for (JsonObject& object : root.objects("presets")) {
        Preset preset{object.text("name"), object.text("description"), object.any("parameters")};
        if (std::ranges::find(presets, preset.name, &Preset::name) != presets.end())
            fail(object.at("name"), ": there are two presets '", shortened(preset.name), "'");
        try {
            make_declared(technique)->params.assign(preset.parameters);
        } catch (const Error& error) {
            fail(object.at("parameters"), ": ", error.what());
        }
        object.finish();
        presets.push_back(std::move(preset));
    }
    return presets;
}

/// Of what can change a pixel.
std::string hash_of(nlohmann::json document, const TechniqueFolder& folder) {
    for (const char* text : {"title", "source", "description", "presets"}) document.erase(text);
    ContentHash hash;
    hash.add(document.dump());
    for (const auto& [name, text] : folder.files) hash.add(name), hash.add(text);
    return hash.hex();
}

fs::path whole_path(const fs::path& folder) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(fs::absolute(folder), error);
    return whole.has_filename() ? whole : whole.parent_path();
}

}  // namespace

std::string declared_name(const fs::path& folder) {
    const std::string name = whole_path(folder).filename().string();
    const auto fits = [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '_'; };
    if (name.empty() || name.size() > 60 || !std::ranges::all_of(name, fits))
        fail("the folder ", folder.string(), " cannot name a technique: its name '", shortened(name),
             "' must be of small letters, digits and '_'");
    return name;
}

VariantEntry declared_entry(const fs::path& named) {
    std::error_code error;
    const fs::path folder = whole_path(named);
    const fs::path file = path_inside(named.lexically_normal(), "technique.json");
    if (!fs::is_regular_file(file, error))
        fail("there is no technique in the folder ", named.string(),
             ": it has no technique.json; `ssrlab new FOLDER --from TECHNIQUE` writes one");
    JsonDocument document = read_json_document(file);
    const nlohmann::json as_written = document.value;
    write_out_short_forms(document.value);
    JsonObject root(document, file.string());
    know_keys(root, {"title", "source", "description", "parameters", "tracers", "resolve", "images", "buffers",
                     "passes", "result", "random", "reflects", "limits", "presets"});

    auto technique = std::make_shared<Technique>();
    technique->name = declared_name(folder);
    VariantEntry entry{.name = technique->name,
                       .title = root.text("title"),
                       .source = root.text("source", ""),
                       .description = root.text("description", ""),
                       .presets = {},
                       .create = {}};
    read_parameters(root, *technique);
    const std::unique_ptr<Variant> plain = make_declared(std::make_shared<Technique>(*technique));
    read_passes(root, KnownValues(plain->params), *technique);
    TechniqueFolder read{.path = folder, .files = {}, .sources = {}, .content_hash = {}};
    read_shaders(*technique, read);
    check_frames(*technique, plain->params);
    entry.limits = technique->limits;
    entry.presets = read_presets(root, technique);
    root.finish();

    read.content_hash = hash_of(as_written, read);
    read.files["technique.json"] = read_text(file);
    entry.create = [technique] { return make_declared(technique); };
    entry.folder = std::make_shared<TechniqueFolder>(std::move(read));
    return entry;
}
