#include "variants/declared/read_parameters.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "variants/declared/names.h"
#include "variants/resolves/resolves.h"

#include <algorithm>

namespace {

using nlohmann::json;

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

Parameter read_parameter(JsonObject object) {
    know_keys(object, {"name", "type", "unit", "meaning", "source", "default", "range", "choices", "compiled_in"});
    Parameter parameter;
    parameter.name = variable_name(object, "name");
    object.any("type");
    const std::string type = object.choice("type", parameter_types, "");
    const bool is_number = type != "bool" && type != "choice";
    parameter.glsl_type = type == "choice" ? "uint" : type;
    parameter.unit = object.text("unit", "");
    parameter.doc = object.text("meaning");
    parameter.source = object.text("source", "");
    if (is_number) read_range(object, parameter);
    if (type == "bool") parameter.min = false, parameter.max = true;
    if (type == "choice") read_choices(object, parameter);
    parameter.use = object.boolean("compiled_in", !is_number) ? Use::constant : Use::uniform;
    const json& initial = object.any("default");
    parameter.value = parameter.initial =
        is_number ? number_of(initial, type, object.at("default") + ": 'default'") : initial;
    ParameterSet alone;
    alone.add(parameter);
    try {
        alone.assign({{parameter.name, parameter.initial}});
    } catch (const Error& error) {
        fail(object.at("default"), ": ", error.what());
    }
    object.finish();
    return parameter;
}

/// "linear_trace" of the slot "linear_tracer".
std::string function_of(const std::string& slot) {
    return slot.ends_with("tracer") ? slot.substr(0, slot.size() - 1) : slot + "_trace";
}

void read_tracers(JsonObject object, Technique& technique) {
    know_keys(object, {"slots", "source", "defaults"});
    for (JsonObject& of_slot : object.objects("slots")) {
        know_keys(of_slot, {"name", "function", "default", "meaning"});
        TracerSlot slot{.name = variable_name(of_slot, "name"), .function = "", .initial = "", .doc = ""};
        slot.function = variable_name(of_slot, "function", function_of(slot.name));
        std::vector<std::string> names;
        for (const TracerEntry& tracer : tracer_table()) names.push_back(tracer.name);
        of_slot.any("default");
        slot.initial = of_slot.choice("default", names, "");
        slot.doc = of_slot.text("meaning", "the march that finds what a ray meets");
        of_slot.finish();
        technique.slots.push_back(slot);
    }
    if (technique.slots.empty()) fail(object.at("slots"), ": 'slots' must name at least one tracer's place");
    technique.tracers_source = object.text("source", "");
    if (object.has("defaults")) technique.tracer_defaults = object.any("defaults");
    object.finish();
    ParameterSet params;
    try {
        Tracers(params, technique.slots, technique.tracers_source, technique.tracer_defaults);
    } catch (const Error& error) {
        fail(object.at("defaults"), ": ", error.what());
    }
}

void read_resolve(JsonObject object, Technique& technique) {
    know_keys(object, {"default", "defaults"});
    std::vector<std::string> names;
    for (const ResolveEntry& resolve : resolve_table()) names.push_back(resolve.name);
    object.any("default");
    DeclaredResolve resolve{.initial = object.choice("default", names, ""), .place = object.where()};
    if (object.has("defaults")) resolve.defaults = object.any("defaults");
    object.finish();
    technique.resolve = std::move(resolve);
    try {
        make_declared(std::make_shared<Technique>(technique));
    } catch (const Error& error) {
        fail(object.at("defaults"), ": ", error.what());
    }
}

/// Fails if two of the parameters that shaders see have one name.
void refuse_repetition(const std::vector<JsonObject>& objects, const Technique& technique) {
    const std::unique_ptr<Variant> variant = make_declared(std::make_shared<Technique>(technique));
    for (size_t i = 0; i < objects.size(); ++i) {
        const std::string& name = technique.parameters[i].name;
        if (name == "resolve" && !technique.resolve)
            fail(objects[i].at("name"),
                 ": the parameter 'resolve' chooses one of ssrlab's resolves, which a technique with "
                 "\"resolve\": {...} has; call yours otherwise");
        if (std::ranges::count(variant->params, name, &Parameter::glsl_name) == 1) continue;
        const auto first = std::ranges::find(technique.parameters, name, &Parameter::name);
        if (first - technique.parameters.begin() < long(i))
            fail(objects[i].at("name"), ": the parameter '", name, "' is declared twice");
        if (std::ranges::count(technique.parameters, name, &Parameter::name) == 1)
            fail(objects[i].at("name"), ": the parameter '", name,
                 "' is one that every such technique, its tracers or its resolve have already; call yours otherwise");
    }
}

}  // namespace

void read_parameters(JsonObject& root, Technique& technique) {
    std::vector<JsonObject> objects = root.objects("parameters");
    for (const JsonObject& object : objects) technique.parameters.push_back(read_parameter(object));
    if (root.has("tracers")) read_tracers(root.object("tracers"), technique);
    if (root.has("resolve")) read_resolve(root.object("resolve"), technique);
    refuse_repetition(objects, technique);
}
