#include "variants/common/parameter_block.h"

#include "core/error.h"
#include "core/former_names.h"
#include "core/near_miss.h"
#include "core/own_files.h"
#include "core/path_inside.h"
#include "variants/common/names.h"
#include "variants/common/plain_texts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> parameter_types = {"bool", "float", "int", "uint", "choice"};

/// A number as a parameter of the type holds it.
json number_of(const json& value, const std::string& type, const std::string& where) {
    if (!(type == "float" ? value.is_number() : is_whole(value)) || (type == "uint" && value.get<double>() < 0))
        fail(where, ": ", shown(value), " is no ", type);
    const auto number = value.get<double>();
    const bool fits = type == "float" ? std::isfinite(float(number))
                      : type == "int" ? number >= -0x1p31 && number < 0x1p31
                                      : number < 0x1p32;
    if (!fits) fail(where, ": ", shown(value), " is too large for a ", type, " of 32 bits");
    return type == "float" ? json_number(float(number)) : with_whole_as_integer(value);
}

void read_range(JsonObject& object, Parameter& parameter) {
    const json& range = object.any("range");
    if (!range.is_array() || range.size() != 2)
        fail(object.at("range"), ": 'range' must be [least, most], not ", shown(range));
    parameter.min = number_of(range[0], parameter.glsl_type, object.at("range") + ": 'range'");
    parameter.max = number_of(range[1], parameter.glsl_type, object.at("range") + ": 'range'");
    if (parameter.min > parameter.max)
        fail(object.at("range"), ": 'range' = ", shown(range), " has nothing in it: the least comes first");
}

void read_choices(JsonObject& object, Parameter& parameter) {
    object.any("choices");  // there must be some
    parameter.choices = object.texts("choices");
    for (auto at = parameter.choices.begin(); at != parameter.choices.end(); ++at)
        if (std::count(parameter.choices.begin(), at, *at) > 0)
            fail(object.at("choices"), ": 'choices' has '", shortened(*at), "' twice");
}

void set_default(JsonObject& object, Parameter& parameter) {
    const json& initial = object.any("default");
    const bool is_number = parameter.choices.empty() && parameter.glsl_type != "bool";
    parameter.value = parameter.initial =
        is_number ? number_of(initial, parameter.glsl_type, object.at("default") + ": 'default'") : initial;
    ParameterSet alone;
    alone.add(parameter);
    try {
        alone.assign({{parameter.name, parameter.initial}});
    } catch (const Error& error) {
        fail(object.at("default"), ": ", error.what());
    }
}

std::string with_prefix(std::string text, const std::string& prefix) {
    const std::string mark = "{prefix}";
    for (size_t at = 0; (at = text.find(mark, at)) != std::string::npos;) text.replace(at, mark.size(), prefix);
    return text;
}

Parameter read_parameter(JsonObject& object, const std::string& prefix) {
    know_keys(object, {"name", "type", "unit", "meaning", "source", "default", "range", "choices", "compiled_in"});
    Parameter parameter;
    parameter.name = variable_name(object, "name");
    object.any("type");
    const std::string type = object.choice("type", parameter_types, "");
    const bool is_number = type != "bool" && type != "choice";
    parameter.glsl_type = type == "choice" ? "uint" : type;
    parameter.unit = object.text("unit", "");
    parameter.doc = with_prefix(object.text("meaning"), prefix);
    parameter.source = object.text("source", "");
    if (is_number) read_range(object, parameter);
    if (type == "bool") parameter.min = false, parameter.max = true;
    if (type == "choice") read_choices(object, parameter);
    parameter.use = object.boolean("compiled_in", !is_number) ? Use::constant : Use::uniform;
    set_default(object, parameter);
    if (!prefix.empty()) parameter.name = prefix + "." + parameter.name;
    object.finish();
    return parameter;
}

auto find_in(std::vector<DeclaredParameter>& all, const std::string& name) {
    return std::ranges::find_if(all, [&](const DeclaredParameter& one) {
        return one.parameter.name.substr(one.parameter.name.find('.') + 1) == name;
    });
}

std::vector<std::string> names_of(JsonObject& include, const std::string& key, std::vector<DeclaredParameter>& block) {
    const std::vector<std::string> names = include.texts(key);
    for (const std::string& name : names)
        if (find_in(block, name) == block.end())
            fail(include.at(key), ": the block has no parameter '", shortened(name), "'");
    return names;
}

}  // namespace

std::vector<DeclaredParameter> ParameterReader::read(JsonObject& owner, const std::string& prefix) {
    std::vector<DeclaredParameter> all;
    for (JsonObject& object : owner.objects("parameters")) {
        if (object.has("include")) {
            for (DeclaredParameter& one : included(std::move(object), prefix)) all.push_back(std::move(one));
        } else {
            const std::string place = object.at("name");
            all.push_back({read_parameter(object, prefix), place});
        }
    }
    return all;
}

std::vector<DeclaredParameter> ParameterReader::included(JsonObject include, const std::string& prefix) {
    know_keys(include, {"include", "prefix", "only", "except", "change"});
    const std::string name = include.text("include"), where = include.at("include");
    std::error_code error;
    const bool is_of_folder = !folder_.empty() && fs::is_regular_file(path_inside(folder_, name, where), error);
    const fs::path file = is_of_folder ? path_inside(folder_, name, where)
                                       : path_inside(own_files() / "variants", present_path(name), where);
    if (!name.ends_with(".json") || !fs::is_regular_file(file, error))
        fail(where, ": 'include' = '", shortened(name), "' is no JSON file of the folder, and none under variants/");
    if (++depth_ > 8) fail(where, ": the blocks of parameters include each other");
    (is_of_folder ? of_folder : of_ssrlab).push_back(is_of_folder ? name : "variants/" + present_path(name));
    const JsonDocument document = read_json_document(file);
    require_plain_texts(document);
    JsonObject root(document, file.string());
    std::vector<DeclaredParameter> block = read(root, variable_name(include, "prefix", prefix));
    root.finish();
    --depth_;

    if (include.has("change")) {
        const JsonObject changes = include.object("change");
        for (const auto& [changed, values] : include.any("change").items()) {
            const auto found = find_in(block, changed);
            if (found == block.end()) fail(changes.at(changed), ": the block has no parameter '", changed, "'");
            JsonObject change = JsonObject(changes).object(changed);
            found->parameter.source = change.text("source", found->parameter.source);
            found->parameter.doc = change.text("meaning", found->parameter.doc);
            if (change.has("default")) set_default(change, found->parameter);
            change.finish();
        }
    }
    const std::vector<std::string> only = names_of(include, "only", block), except = names_of(include, "except", block);
    std::erase_if(block, [&](const DeclaredParameter& one) {
        const std::string own = one.parameter.name.substr(one.parameter.name.find('.') + 1);
        return std::ranges::count(except, own) || (!only.empty() && !std::ranges::count(only, own));
    });
    include.finish();
    return block;
}

void add_block(ParameterSet& params, const std::string& file) {
    static std::mutex mutex;
    static std::map<std::string, std::vector<DeclaredParameter>> blocks;
    const std::scoped_lock lock(mutex);
    const auto [block, is_new] = blocks.try_emplace(file);
    if (is_new) {
        const json owner = {{"parameters", {{{"include", file}}}}};
        JsonObject root(owner, file);
        block->second = ParameterReader().read(root);
    }
    for (const DeclaredParameter& declared : block->second) params.add(declared.parameter);
}
