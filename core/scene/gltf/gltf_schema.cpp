#include "core/scene/gltf/gltf_schema.h"

#include "core/error.h"
#include "core/json.h"
#include "core/near_miss.h"

#include <climits>
#include <memory>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace {
using nlohmann::json;

// Parts of a JSON Schema, each with what it allows as the "description" that messages quote.

const json text = {{"type", "string"}, {"description", "a text"}};
const json flag = {{"type", "boolean"}, {"description", "true or false"}};
const json number = {{"type", "number"}, {"description", "a number"}};
const json index = {{"type", "integer"},
                    {"minimum", 0},
                    {"maximum", INT_MAX},
                    {"description", "a whole number from 0 to " + std::to_string(INT_MAX)}};
const json size = {{"type", "integer"}, {"minimum", 0}, {"description", "a whole number of 0 or more"}};

json one_of(const json& values) { return {{"enum", values}, {"description", "one of " + values.dump()}}; }

json list_of(const json& items) {
    return {{"type", "array"},
            {"items", items},
            {"description", "an array, each element of it " + items["description"].get<std::string>()}};
}

json numbers(size_t count) {
    return {{"type", "array"},
            {"items", number},
            {"minItems", count},
            {"maxItems", count},
            {"description", "an array of " + std::to_string(count) + " numbers"}};
}

/// `members` by name; those of `needed` must be there.
json object(const json& members, const json& needed = json::array()) {
    json schema = {{"type", "object"}, {"properties", members}, {"description", "an object"}};
    if (!needed.empty()) schema["required"] = needed;
    return schema;
}

/// An object whose members have any names.
json object_of(const json& member) {
    return {{"type", "object"}, {"additionalProperties", member}, {"description", "an object"}};
}

json objects(const json& members, const json& needed = json::array()) { return list_of(object(members, needed)); }

json extensions(const json& known) { return object(known); }

/// A textureInfo, with the members that some have beside those of all.
json texture(const json& more = json::object()) {
    json members = {
        {"index", index},
        {"texCoord", index},
        {"extensions",
         extensions(
             {{"KHR_texture_transform",
               object({{"offset", numbers(2)}, {"rotation", number}, {"scale", numbers(2)}, {"texCoord", index}})}})}};
    members.update(more);
    return object(members, {"index"});
}

json material_extensions() {
    const json none = json::object();
    return extensions(
        {{"KHR_materials_anisotropy", object({{"anisotropyStrength", number}})},
         {"KHR_materials_clearcoat", object({{"clearcoatFactor", number}})},
         {"KHR_materials_diffuse_transmission", object({{"diffuseTransmissionFactor", number}})},
         {"KHR_materials_dispersion", object({{"dispersion", number}})},
         {"KHR_materials_emissive_strength", object({{"emissiveStrength", number}})},
         {"KHR_materials_ior", object({{"ior", number}})},
         {"KHR_materials_iridescence", object({{"iridescenceFactor", number}})},
         {"KHR_materials_pbrSpecularGlossiness", object({{"diffuseFactor", numbers(4)},
                                                         {"diffuseTexture", texture()},
                                                         {"specularFactor", numbers(3)},
                                                         {"glossinessFactor", number},
                                                         {"specularGlossinessTexture", texture()}})},
         {"KHR_materials_sheen", object({{"sheenColorFactor", numbers(3)}})},
         {"KHR_materials_specular", object({{"specularFactor", number},
                                            {"specularTexture", texture()},
                                            {"specularColorFactor", numbers(3)},
                                            {"specularColorTexture", texture()}})},
         {"KHR_materials_transmission", object({{"transmissionFactor", number}, {"transmissionTexture", texture()}})},
         {"KHR_materials_unlit", object(none)},
         {"KHR_materials_volume", object({{"thicknessFactor", number}})}});
}

json materials() {
    return objects({{"name", text},
                    {"pbrMetallicRoughness", object({{"baseColorFactor", numbers(4)},
                                                     {"baseColorTexture", texture()},
                                                     {"metallicFactor", number},
                                                     {"roughnessFactor", number},
                                                     {"metallicRoughnessTexture", texture()}})},
                    {"normalTexture", texture({{"scale", number}})},
                    {"occlusionTexture", texture({{"strength", number}})},
                    {"emissiveTexture", texture()},
                    {"emissiveFactor", numbers(3)},
                    {"alphaMode", one_of({"OPAQUE", "MASK", "BLEND"})},
                    {"alphaCutoff", number},
                    {"doubleSided", flag},
                    {"extensions", material_extensions()}});
}

json buffer_views() {
    const json meshopt = object({{"buffer", index},
                                 {"byteOffset", size},
                                 {"byteLength", size},
                                 {"byteStride", size},
                                 {"count", size},
                                 {"mode", one_of({"ATTRIBUTES", "TRIANGLES", "INDICES"})},
                                 {"filter", one_of({"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"})}},
                                {"buffer", "byteLength", "byteStride", "count", "mode"});
    return objects(
        {{"name", text},
         {"buffer", index},
         {"byteOffset", size},
         {"byteLength", size},
         {"byteStride", size},
         {"target", one_of({34962, 34963})},
         {"extensions", extensions({{"EXT_meshopt_compression", meshopt}, {"KHR_meshopt_compression", meshopt}})}},
        {"buffer", "byteLength"});
}

json accessors() {
    const json sparse =
        object({{"count", index},
                {"indices",
                 object({{"bufferView", index}, {"byteOffset", index}, {"componentType", one_of({5121, 5123, 5125})}},
                        {"bufferView", "componentType"})},
                {"values", object({{"bufferView", index}, {"byteOffset", index}}, {"bufferView"})}},
               {"count", "indices", "values"});
    return objects({{"name", text},
                    {"bufferView", index},
                    {"byteOffset", size},
                    {"componentType", one_of({5120, 5121, 5122, 5123, 5125, 5126})},
                    {"normalized", flag},
                    {"count", size},
                    {"type", one_of({"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"})},
                    {"max", list_of(number)},
                    {"min", list_of(number)},
                    {"sparse", sparse}},
                   {"componentType", "count", "type"});
}

json meshes() {
    const json attributes = object_of(index);
    const json variants =
        object({{"mappings", objects({{"material", index}, {"variants", list_of(index)}}, {"material", "variants"})}},
               {"mappings"});
    const json draco = object({{"bufferView", index}, {"attributes", attributes}}, {"bufferView", "attributes"});
    const json primitives = objects(
        {{"attributes", attributes},
         {"indices", index},
         {"material", index},
         {"mode", one_of({0, 1, 2, 3, 4, 5, 6})},
         {"targets", list_of(attributes)},
         {"extensions", extensions({{"KHR_materials_variants", variants}, {"KHR_draco_mesh_compression", draco}})}},
        {"attributes"});
    return objects({{"name", text}, {"primitives", primitives}, {"weights", list_of(number)}}, {"primitives"});
}

json animations() {
    const json target =
        object({{"node", index},
                {"path", text},
                {"extensions", extensions({{"KHR_animation_pointer", object({{"pointer", text}}, {"pointer"})}})}},
               {"path"});
    const json samplers =
        objects({{"input", index}, {"output", index}, {"interpolation", one_of({"LINEAR", "STEP", "CUBICSPLINE"})}},
                {"input", "output"});
    return objects({{"name", text},
                    {"channels", objects({{"sampler", index}, {"target", target}}, {"sampler", "target"})},
                    {"samplers", samplers}},
                   {"channels", "samplers"});
}

json cameras() {
    const json orthographic = object({{"xmag", number}, {"ymag", number}, {"zfar", number}, {"znear", number}},
                                     {"xmag", "ymag", "zfar", "znear"});
    const json perspective =
        object({{"aspectRatio", number}, {"yfov", number}, {"zfar", number}, {"znear", number}}, {"yfov", "znear"});
    return objects({{"name", text},
                    {"type", one_of({"perspective", "orthographic"})},
                    {"orthographic", orthographic},
                    {"perspective", perspective}},
                   {"type"});
}

json lights() {
    return objects({{"name", text},
                    {"type", one_of({"directional", "point", "spot"})},
                    {"color", numbers(3)},
                    {"intensity", number},
                    {"range", number},
                    {"spot", object({{"innerConeAngle", number}, {"outerConeAngle", number}})}},
                   {"type"});
}

json nodes() {
    return objects({{"name", text},
                    {"camera", index},
                    {"children", list_of(index)},
                    {"skin", index},
                    {"matrix", numbers(16)},
                    {"mesh", index},
                    {"rotation", numbers(4)},
                    {"scale", numbers(3)},
                    {"translation", numbers(3)},
                    {"weights", list_of(number)},
                    {"extensions", extensions({{"EXT_mesh_gpu_instancing",
                                                object({{"attributes", object_of(index)}}, {"attributes"})},
                                               {"KHR_lights_punctual", object({{"light", index}}, {"light"})},
                                               {"KHR_node_visibility", object({{"visible", flag}})}})}});
}

/// glTF 2.0, section 5: every key that ssrlab reads, and those that it passes by but tinygltf reads.
json gltf_schema() {
    const json version = {
        {"type", "string"}, {"pattern", "^2[.][0-9]+$"}, {"description", "\"2.0\": ssrlab reads glTF 2"}};
    const json least_version = {{"const", "2.0"}, {"description", "\"2.0\": ssrlab reads glTF 2.0"}};
    const json wrap = one_of({33071, 33648, 10497});
    return object(
        {{"asset",
          object({{"version", version}, {"minVersion", least_version}, {"copyright", text}, {"generator", text}},
                 {"version"})},
         {"extensionsUsed", list_of(text)},
         {"extensionsRequired", list_of(text)},
         {"scene", index},
         {"scenes", objects({{"name", text}, {"nodes", list_of(index)}})},
         {"nodes", nodes()},
         {"meshes", meshes()},
         {"accessors", accessors()},
         {"bufferViews", buffer_views()},
         {"buffers", objects({{"name", text}, {"uri", text}, {"byteLength", size}}, {"byteLength"})},
         {"images", objects({{"name", text}, {"uri", text}, {"mimeType", text}, {"bufferView", index}})},
         {"samplers", objects({{"name", text},
                               {"magFilter", one_of({9728, 9729})},
                               {"minFilter", one_of({9728, 9729, 9984, 9985, 9986, 9987})},
                               {"wrapS", wrap},
                               {"wrapT", wrap}})},
         {"textures", objects({{"name", text},
                               {"sampler", index},
                               {"source", index},
                               {"extensions", extensions({{"EXT_texture_webp", object({{"source", index}})}})}})},
         {"materials", materials()},
         {"cameras", cameras()},
         {"animations", animations()},
         {"skins",
          objects({{"name", text}, {"inverseBindMatrices", index}, {"skeleton", index}, {"joints", list_of(index)}},
                  {"joints"})},
         {"extensions", extensions({{"KHR_lights_punctual", object({{"lights", lights()}}, {"lights"})},
                                    {"KHR_materials_variants",
                                     object({{"variants", objects({{"name", text}}, {"name"})}}, {"variants"})}})}},
        {"asset"});
}

/// The validator's name of a member or an element, as "[nodes]" or "[1]", without its brackets.
std::string bare(const std::string& step) { return step.substr(1, step.size() - 2); }

/// What is wrong at the end of `path`, by the schema and the value found there.
std::string complaint(const json& schema, const json& root, const std::vector<std::string>& path,
                      const std::string& fallback) {
    const json *allowed = &schema, *found = &root;
    std::string place;
    for (size_t i = 1; i < path.size(); ++i) {
        const std::string step = bare(path[i]);
        if (found->is_array()) {
            place += "[" + step + "]";
            allowed = &allowed->at("items"), found = &found->at(std::stoul(step));
        } else {
            place += (place.empty() ? "" : ".") + shortened(step);
            const bool is_named = allowed->contains("properties") && allowed->at("properties").contains(step);
            allowed = is_named ? &allowed->at("properties").at(step) : &allowed->at("additionalProperties");
            found = &found->at(step);
        }
    }
    const std::string where = place.empty() ? "" : place + ": ";
    if (found->is_object())
        for (const json& key : allowed->value("required", json::array()))
            if (!found->contains(key.get<std::string>()))
                return where + "lacks the key '" + key.get<std::string>() + "'";
    if (!allowed->contains("description")) return where + fallback;
    return where + "must be " + allowed->at("description").get<std::string>() + ", not " + shown(*found);
}

bool takes_integers(const json& schema) {
    return schema.value("type", "") == "integer" || (schema.contains("enum") && schema["enum"][0].is_number_integer());
}

void make_whole(json& value, const json& schema) {
    if (value.is_number_float() && takes_integers(schema)) {
        value = with_whole_as_integer(value);
    } else if (value.is_array() && schema.contains("items")) {
        for (json& element : value) make_whole(element, schema["items"]);
    } else if (value.is_object()) {
        for (auto& [key, member] : value.items())
            if (schema.contains("properties") && schema["properties"].contains(key))
                make_whole(member, schema["properties"][key]);
            else if (schema.contains("additionalProperties"))
                make_whole(member, schema["additionalProperties"]);
    }
}

const json& declared_schema() {
    static const json declared = gltf_schema();
    return declared;
}
}  // namespace

void make_integers_whole(json& root) { make_whole(root, declared_schema()); }

void check_gltf_schema(const json& root, const std::string& file) {
    using valijson::ValidationResults, valijson::Validator, valijson::adapters::NlohmannJsonAdapter;
    const json& declared = declared_schema();
    static const std::unique_ptr<const valijson::Schema> schema = [] {
        auto parsed = std::make_unique<valijson::Schema>();
        valijson::SchemaParser().populateSchema(NlohmannJsonAdapter(declared_schema()), *parsed);
        return parsed;
    }();
    ValidationResults results;
    if (Validator(Validator::kStrongTypes).validate(*schema, NlohmannJsonAdapter(root), &results)) return;
    ValidationResults::Error error, deepest;  // the others say that what encloses it does not fit, either
    while (results.popError(error))
        if (error.context.size() > deepest.context.size()) deepest = error;
    fail(file, ": ", complaint(declared, root, deepest.context, deepest.description));
}
