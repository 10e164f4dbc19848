#include "experiments/config/config_schema.h"

#include "core/gpu/pass_cost.h"
#include "experiments/config/config.h"
#include "experiments/config/config_parts.h"
#include "experiments/config/design.h"
#include "metrics/masks.h"
#include "metrics/metric.h"
#include "variants/registry.h"

namespace {

using nlohmann::json;

json one_or_more(const json& item) {
    return {{"anyOf", {item, {{"type", "array"}, {"items", item}, {"minItems", 1}}}}};
}
json masks() {
    return one_or_more(
        {{"anyOf", {{{"enum", mask_names()}}, {{"type", "string"}, {"pattern", roughness_class_pattern}}}}});
}
json list_of(const std::vector<std::string>& names) { return one_or_more({{"enum", names}}); }
json object(const json& members, const std::vector<std::string>& required = {}) {
    return {{"type", "object"}, {"properties", members}, {"required", required}, {"additionalProperties", false}};
}
json number(double min, double max) { return {{"type", "number"}, {"minimum", min}, {"maximum", max}}; }
json integer(int min, int max) { return {{"type", "integer"}, {"minimum", min}, {"maximum", max}}; }

json array_of(const json& items, int least = 1) { return {{"type", "array"}, {"items", items}, {"minItems", least}}; }
json any_of(const std::vector<json>& schemas) { return {{"anyOf", schemas}}; }

/// {"lin": [from, to]} or {"log": [from, to]}, with `more` numbers behind the ends.
json range(unsigned more) {
    json numbers = array_of({{"type", "number"}}, int(2 + more));
    numbers["maxItems"] = 2 + more;
    return any_of({object({{"lin", numbers}}, {"lin"}), object({{"log", numbers}}, {"log"})});
}

json counts(unsigned max) {
    return {{"anyOf", {integer(1, int(max)), {{"type", "array"}, {"items", integer(0, int(max))}}}}};
}

std::string description_of(const VariantEntry& entry) {
    const std::string limits = limits_text(entry.limits);
    return entry.title + " (" + entry.source + ")" + (limits.empty() ? "" : "; enforced limits: " + limits);
}

json variant_schema(const VariantEntry& entry) {
    const json parameters = make_variant(entry.name)->params.schema();
    json axes = parameters, ranges = parameters;
    for (auto& [name, schema] : axes["properties"].items()) {
        const json description = schema["description"], values = array_of(schema);
        const bool is_number = schema.contains("minimum");
        schema = is_number ? any_of({values, range(1)}) : values;
        json& sampled = ranges["properties"][name];
        sampled = is_number ? any_of({values, range(0)}) : values;
        schema["description"] = sampled["description"] = description;
    }
    const json sample = object(
        {{"count", integer(1, int(most_points))}, {"seed", integer(0, 1 << 30)}, {"axes", ranges}}, {"count", "axes"});
    const json conditions = {{"type", "object"}};  // read_conditions() checks them
    std::vector<std::string> presets = {""};
    for (const Preset& preset : entry.presets) presets.push_back(preset.name);
    return object({{"variant", {{"const", entry.name}, {"description", description_of(entry)}}},
                   {"preset", list_of(presets)},
                   {"parameters", parameters},
                   {"sweep", axes},
                   {"zip", axes},
                   {"each", axes},
                   {"random", sample},
                   {"latin_hypercube", sample},
                   {"sobol", sample},
                   {"only_if", conditions},
                   {"skip_if", conditions},
                   {"label", {{"type", "string"}}},
                   {"group", {{"type", "string"}}},
                   {"remove", {{"type", "boolean"}}},
                   {"seeds", counts(100000)},
                   {"baseline", {{"type", "boolean"}}},
                   {"against", parameters},
                   {"timing", {{"type", "boolean"}}}},
                  {"variant"});
}

json table_schema() {
    const json text = {{"type", "string"}}, any_object = {{"type", "object"}};
    return object({{"name", text},
                   {"caption", text},
                   {"of", {{"enum", table_sources}}},
                   {"where", any_object},
                   {"rows", one_or_more(text)},
                   {"columns", one_or_more(text)},
                   {"over", text},
                   {"sort", text},
                   {"best", {{"enum", {"column", "row"}}}},
                   {"labels", any_object}},
                  {"name", "caption", "of", "rows", "columns"});
}

json tune_schema(const json& shots) {
    const json values = {{"type", "array"}, {"minItems", 1}}, conditions = {{"type", "object"}};
    json axis = object({{"values", values}, {"only_if", conditions}, {"skip_if", conditions}});
    for (const char* kind : {"lin", "log"}) axis["properties"][kind] = range(0)["anyOf"][0]["properties"]["lin"];
    std::vector<std::string> times = {"milliseconds"};
    for (const CostQuantity& quantity : cost_quantities) times.push_back(quantity.name);
    return object({{"axes", {{"type", "object"}, {"additionalProperties", any_of({values, axis})}}},
                   {"start", {{"type", "string"}}},
                   {"judge", object({{"shots", shots}, {"seeds", counts(100000)}}, {"shots"})},
                   {"metrics", list_of(metric_names())},
                   {"target", {{"enum", target_names()}}},
                   {"mask", {{"type", "string"}}},
                   {"time", {{"enum", times}}},
                   {"budgets", array_of({{"type", "number"}, {"exclusiveMinimum", 0}})},
                   {"most_runs", integer(1, 1 << 30)},
                   {"most_minutes", number(0, 1e7)},
                   {"batch", integer(1, 256)},
                   {"seed", integer(0, 1 << 30)}});
}

}  // namespace

nlohmann::json config_schema(const std::string& variant) {
    const std::string dialect = "https://json-schema.org/draft/2020-12/schema";
    if (!variant.empty()) {
        find_variant(variant);
        json schema = make_variant(variant)->params.schema();
        schema["$schema"] = dialect;
        schema["title"] = "Parameters of " + variant;
        return schema;
    }
    json variants = json::array();
    for (const VariantEntry& entry : variant_table()) variants.push_back(variant_schema(entry));
    const json text = {{"type", "string"}};
    json playing = counts(100000);
    playing["anyOf"].push_back(object({{"from", integer(0, 100000)}, {"to", integer(0, 100000)}}, {"from", "to"}));
    json extent = array_of(integer(1, 16384), 2);
    extent["maxItems"] = 2;
    const json extents = any_of({extent, array_of(extent)});
    const json settings = {{"lit", list_of({"path_traced", "direct"})},
                           {"depth_format", list_of({"d32f", "d24", "d16"})},
                           {"depth_direction", list_of({"standard", "reversed"})},
                           {"normal_encoding", list_of({"float", "octahedral_16", "octahedral_8"})}};
    const json timeline = {{"measure_from", integer(0, 100000)},
                           {"warm_up", integer(0, 100000)},
                           {"repeat", integer(1, 100000)},
                           {"change", integer(1, 100000)},
                           {"measure", {{"enum", {"all", "last"}}}},
                           {"label", text},
                           {"group", text}};
    json shot_members = {{"scene", one_or_more(text)},
                         {"camera", one_or_more(text)},
                         {"resolution", extents},
                         {"frames", any_of({playing, array_of(playing)})}},
         capture_members = {{"gbuffer", text}, {"reference", text}, {"frames", playing}};
    for (json* members : {&shot_members, &capture_members}) members->update(timeline), members->update(settings);
    const json shot = object(shot_members, {"scene"}), capture = object(capture_members, {"gbuffer"});
    const json shots = array_of({{"anyOf", {shot, capture}}});
    json samples = integer(16, 1 << 24);
    samples["description"] = "per pixel, at most; without it " + std::to_string(ReferenceSettings::default_samples) +
                             ", or no limit if seconds or target_relative_error is set";
    const json reference = object({{"samples", samples},
                                   {"seconds", number(0, 1e7)},
                                   {"target_relative_error", number(0, 1)},
                                   {"max_depth", integer(1, 1024)},
                                   {"seed", integer(0, 1 << 30)}});
    json members = {
        {"$schema", text},
        {"extends", text},
        {"title", text},
        {"shots", shots},
        {"variants", {{"type", "array"}, {"items", {{"anyOf", variants}}}, {"minItems", 1}}},
        {"seeds", counts(100000)},
        {"reference", {{"anyOf", {reference, {{"const", "none"}}}}}},
        {"composite", {{"enum", {"split_sum", "additive_fresnel"}}}},
        {"resolution", extents},
        {"timing",
         object({{"frames", integer(0, 100000)},
                 {"warm_up", integer(1, 1000)},
                 {"most_share", number(0, 1e6)},
                 {"copies", {{"type", "boolean"}}}})},
        {"hits", object({{"every", integer(1, 64)}, {"seeds", integer(1, 1000000)}})},
        {"costs", {{"type", "boolean"}}},
        {"images", {{"enum", {"last", "all"}}}},
        {"metrics", list_of(metric_names())},
        {"masks", masks()},
        {"frame_metrics", {{"anyOf", {list_of(metric_names()), {{"type", "array"}, {"maxItems", 0}}}}}},
        {"frame_masks", masks()},
        {"targets", list_of(target_names())},
        {"primary", object({{"metric", text}, {"mask", text}, {"target", {{"enum", target_names()}}}})},
        {"reflective_max_roughness", number(0, 1)},
        {"reflective_min_reflectance", number(0, 1)},
        {"tables", {{"type", "array"}, {"items", table_schema()}}},
        {"tune", tune_schema(shots)}};
    members.update(settings);
    json schema = object(members);
    schema["anyOf"] = {{{"required", {"shots", "variants"}}}, {{"required", {"extends"}}}};
    schema["$schema"] = dialect;
    schema["title"] = "ssrlab study";
    return schema;
}
