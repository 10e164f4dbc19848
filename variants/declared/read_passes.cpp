#include "variants/declared/read_passes.h"

#include "core/error.h"
#include "core/gpu/format.h"
#include "core/gpu/pipelines/shader.h"
#include "core/near_miss.h"
#include "variants/declared/names.h"
#include "variants/declared/provided_images.h"

#include <algorithm>

namespace {

using nlohmann::json;

constexpr int largest_side = 16384, most_mips = 15;  // of any device
constexpr int most_bytes = 1 << 28;

Format read_format(JsonObject& object) {
    std::vector<std::string> names;
    for (const FormatFacts& facts : all_formats()) names.push_back(facts.name);
    object.any("format");
    const std::string name = object.choice("format", names, "");
    return all_formats()[size_t(std::ranges::find(names, name) - names.begin())].format;
}

DeclaredImage read_image(JsonObject object, const KnownValues& known) {
    know_keys(object, {"name", "format", "divisor", "size", "mips", "history", "when"});
    DeclaredImage image;
    image.place = object.at("name");
    image.name = variable_name(object, "name");
    if (ProvidedImages::has(image.name))
        fail(image.place, ": every technique has an image '", image.name, "' already; call yours otherwise");
    image.format = read_format(object);
    image.divisor = unsigned(object.integer("divisor", 1, largest_side, 1));
    if (object.has("size")) {
        const json& size = object.any("size");
        const auto fits = [](const json& side) { return is_whole(side) && side >= 1 && side <= largest_side; };
        if (!size.is_array() || size.size() != 2 || !std::ranges::all_of(size, fits))
            fail(object.at("size"), ": 'size' must be [width, height] in pixels, each in [1, ", largest_side, "], not ",
                 shown(size));
        image.size = {size[0].get<unsigned>(), size[1].get<unsigned>()};
        if (object.has("divisor")) fail(object.at("divisor"), ": an image has either a 'size' or a 'divisor'");
    }
    image.mips = unsigned(object.integer("mips", 1, most_mips, 1));
    image.has_history = object.boolean("history", false);
    if (image.has_history && image.mips > 1)
        fail(object.at("mips"), ": an image with a history has no mips; keep each level as an image of its own");
    image.when = Condition(object, "when", known);
    object.finish();
    return image;
}

DeclaredBuffer read_buffer(JsonObject object, const KnownValues& known) {
    know_keys(object, {"name", "bytes", "bytes_per_pixel", "when"});
    DeclaredBuffer buffer;
    buffer.place = object.at("name");
    buffer.name = variable_name(object, "name");
    buffer.bytes = unsigned(object.integer("bytes", 0, most_bytes, 0));
    buffer.bytes_per_pixel = unsigned(object.integer("bytes_per_pixel", 0, 1024, 0));
    if (buffer.bytes % 4 != 0 || buffer.bytes_per_pixel % 4 != 0 || buffer.bytes + buffer.bytes_per_pixel == 0)
        fail(buffer.place, ": the buffer '", buffer.name,
             "' must have 'bytes' or 'bytes_per_pixel', in multiples of 4");
    buffer.when = Condition(object, "when", known);
    object.finish();
    return buffer;
}

std::optional<unsigned> read_mip(JsonObject& object) {
    if (!object.has("mip")) return {};
    return unsigned(object.integer("mip", 0, most_mips - 1));
}

Condition read_linear(JsonObject& object, const KnownValues& known) {
    if (!object.has("linear")) return Condition::never();
    if (const json& value = object.any("linear"); value.is_boolean())
        return value == true ? Condition() : Condition::never();
    return {object, "linear", known};
}

DeclaredUse read_use(JsonObject object, bool is_read, const KnownValues& known) {
    know_keys(object, {"image", "as", "mip", "when"});
    if (is_read) know_keys(object, {"linear", "wrap_u", "wrap_v"});
    DeclaredUse use;
    use.place = object.at("image");
    use.image = object.text("image");
    use.as = variable_name(object, "as", use.image);
    use.mip = read_mip(object);
    use.when = Condition(object, "when", known);
    if (is_read) {
        const std::vector<std::pair<std::string, Wrap>> wraps = {
            {"clamp", Wrap::clamp}, {"repeat", Wrap::repeat}, {"mirrored_repeat", Wrap::mirrored_repeat}};
        use.is_linear = read_linear(object, known);
        use.wrap_u = object.value_of("wrap_u", wraps), use.wrap_v = object.value_of("wrap_v", wraps);
    }
    object.finish();
    return use;
}

DeclaredTest read_depth(JsonObject object, const KnownValues& known) {
    know_keys(object, {"image", "compare", "write", "when"});
    DeclaredTest test;
    test.place = object.at("image");
    test.image = object.text("image");
    using Compare = DepthTest::Compare;
    test.compare = object.value_of<Compare>("compare", {{"less", Compare::less},
                                                        {"greater", Compare::greater},
                                                        {"less_or_equal", Compare::less_or_equal},
                                                        {"greater_or_equal", Compare::greater_or_equal},
                                                        {"equal", Compare::equal},
                                                        {"always", Compare::always}});
    test.is_written = object.boolean("write", false);
    test.when = Condition(object, "when", known);
    object.finish();
    return test;
}

DeclaredTest read_stencil(JsonObject object, const KnownValues& known) {
    know_keys(object, {"image", "write", "equal", "when"});
    DeclaredTest test;
    test.place = object.at("image");
    test.image = object.text("image");
    test.is_written = object.has("write");
    if (test.is_written == object.has("equal"))
        fail(test.place, ": 'stencil' has either a value to 'write', or one that is 'equal' where to draw");
    test.mode = test.is_written ? Stencil::Mode::write : Stencil::Mode::keep_equal;
    test.value = unsigned(object.integer(test.is_written ? "write" : "equal", 0, 255));
    test.when = Condition(object, "when", known);
    object.finish();
    return test;
}

/// Whole numbers are int or uint, others float, four numbers vec4.
PushValue read_push_value(const json& value, const std::string& where) {
    if (value.is_number_integer() && value >= -0x1p31 && value < 0x1p32)
        return int(uint32_t(value.get<int64_t>()));  // the same bits in both types
    if (value.is_number_float()) return value.get<float>();
    const auto is_number = [](const json& one) { return one.is_number(); };
    if (!value.is_array() || value.size() != 4 || !std::ranges::all_of(value, is_number))
        fail(where, ": must be a whole number (int, uint), one with a point (float), or an array of four (vec4), not ",
             shown(value));
    glm::vec4 vector;
    for (int i = 0; i < 4; ++i) vector[i] = value[size_t(i)].get<float>();
    return vector;
}

void read_rays(JsonObject& object, const Technique& technique, DeclaredPass& pass) {
    if (!object.has("rays")) return;
    if (!object.any("rays").is_string()) {
        pass.rays = unsigned(object.integer("rays", 1, 64));
        return;
    }
    std::vector<std::string> counts;
    for (const Parameter& p : technique.parameters)
        if (p.choices.empty() && (p.glsl_type == "uint" || p.glsl_type == "int") && p.min >= 1 && p.max <= 64)
            counts.push_back(p.name);
    if (technique.resolve) counts.push_back("max_rays");
    pass.rays_parameter = object.text("rays");
    if (!std::ranges::count(counts, pass.rays_parameter))
        fail(object.at("rays"), ": 'rays' names '", shortened(pass.rays_parameter),
             "', which is no parameter of whole numbers in [1, 64]", suggestion(pass.rays_parameter, counts));
}

std::map<std::string, Condition> read_scene_constants(JsonObject object, const KnownValues& known) {
    std::map<std::string, Condition> found;
    for (const char* name : {"scene_is_still", "scene_has_environment", "scene_has_matte"}) {
        if (!object.has(name)) continue;
        if (object.any(name) == true)
            found[name] = Condition();
        else
            found[name] = Condition(object, name, known);
    }
    object.finish();
    return found;
}

/// An image or a buffer that is filled with a value, without a shader.
void read_clear(JsonObject& object, DeclaredPass& pass) {
    know_keys(object, {"value", "when"});
    pass.cleared = object.text("clear");
    pass.stage = "clear";
    pass.set["value"] =
        object.has("value") ? read_push_value(object.any("value"), object.at("value") + ": 'value'") : glm::vec4(0);
}

void read_shader(JsonObject& object, const Technique& technique, const KnownValues& known, DeclaredPass& pass) {
    know_keys(object, {"shader", "stage", "reads", "writes", "depth", "stencil", "buffers", "tracers", "rays", "over",
                       "set", "environment", "scene_constants", "when"});
    pass.shader = object.text("shader");
    pass.is_compute = pass.shader.ends_with(".comp");
    if (!pass.is_compute && !pass.shader.ends_with(".frag"))
        fail(object.at("shader"), ": 'shader' = '", shortened(pass.shader),
             "' must end in .comp, a compute shader, or in .frag, a fragment shader over the whole image");
    if (object.has("stage")) pass.stage = variable_name(object, "stage");
    for (JsonObject& read : object.objects("reads")) pass.reads.push_back(read_use(std::move(read), true, known));
    for (JsonObject& write : object.objects("writes")) pass.writes.push_back(read_use(std::move(write), false, known));
    if (object.has("depth")) pass.depth = read_depth(object.object("depth"), known);
    if (object.has("stencil")) pass.stencil = read_stencil(object.object("stencil"), known);
    for (const auto& test : {pass.depth, pass.stencil})
        if (test && pass.is_compute) fail(test->place, ": only a fragment shader is tested by depth or stencil");
    pass.buffers = object.texts("buffers");
    for (const std::string& buffer : pass.buffers) {
        std::vector<std::string> names = technique.resolve ? ray_buffers : std::vector<std::string>();
        for (const DeclaredBuffer& known_buffer : technique.buffers) names.push_back(known_buffer.name);
        if (!std::ranges::count(names, buffer))
            fail(object.at("buffers"), ": there is no buffer '", shortened(buffer), "'", suggestion(buffer, names));
    }
    pass.tracers = object.texts("tracers");
    for (const std::string& slot : pass.tracers) {
        std::vector<std::string> names;
        for (const TracerSlot& known_slot : technique.slots) names.push_back(known_slot.name);
        if (!std::ranges::count(names, slot))
            fail(object.at("tracers"), ": 'tracers' has no slot '", shortened(slot), "'", suggestion(slot, names));
    }
    read_rays(object, technique, pass);
    if (object.has("over")) {
        pass.over = object.text("over");
        if (!pass.is_compute) fail(object.at("over"), ": a fragment shader runs over the images that it writes");
    }
    if (object.has("set")) {
        const JsonObject values = object.object("set");
        for (const auto& [name, value] : object.any("set").items())
            pass.set[name] = read_push_value(value, values.at(name) + ": '" + shortened(name) + "'");
    }
    pass.has_environment = object.boolean("environment", false);
    if (object.has("scene_constants"))
        pass.scene_constants = read_scene_constants(object.object("scene_constants"), known);
}

DeclaredPass read_pass(JsonObject object, const Technique& technique, const KnownValues& known) {
    DeclaredPass pass;
    pass.place = object.where();
    if (object.has("clear"))
        read_clear(object, pass);
    else
        read_shader(object, technique, known, pass);
    pass.when = Condition(object, "when", known);
    object.finish();
    return pass;
}

DeclaredResult read_result(JsonObject object, const KnownValues& known) {
    know_keys(object, {"radiance", "confidence", "channel", "when"});
    DeclaredResult result;
    result.place = object.where();
    result.radiance = object.text("radiance");
    result.confidence = object.text("confidence");
    result.channel = object.value_of<unsigned>("channel", {{"r", 0}, {"g", 1}, {"b", 2}, {"a", 3}});
    result.when = Condition(object, "when", known);
    object.finish();
    return result;
}

RoughnessLimit read_limit(JsonObject object, const Technique& technique) {
    RoughnessLimit limit;
    limit.is_excluded = object.has("below");
    const std::string key = limit.is_excluded ? "below" : "up_to";
    limit.parameter = object.text(key);
    std::vector<std::string> numbers;
    for (const Parameter& p : technique.parameters)
        if (p.glsl_type == "float") numbers.push_back(p.name);
    if (!std::ranges::count(numbers, limit.parameter))
        fail(object.at(key), ": '", key, "' names '", shortened(limit.parameter), "', which is no float parameter",
             suggestion(limit.parameter, numbers));
    object.finish();
    return limit;
}

VariantLimits read_limits(JsonObject object, const KnownValues& known) {
    know_keys(object, {"api", "lifted_by"});
    VariantLimits limits;
    object.any("api");
    limits.api = object.value_of<Limits>("api", {{"webgl2", Limits::webgl2}});
    if (object.has("lifted_by")) {
        Condition(object, "lifted_by", known);  // which knows parameters and their values
        limits.lifted_by = object.any("lifted_by");
        for (const auto& [name, value] : limits.lifted_by.items())
            if (value.is_structured() || name.starts_with("shot."))
                fail(object.at("lifted_by"), ": '", shortened(name), "' must be a parameter with one value");
    }
    object.finish();
    return limits;
}

void write_out(json& owner, const std::string& key) {
    if (!owner.is_object() || !owner.contains(key)) return;
    json& value = owner[key];
    if (!value.is_array()) value = json::array({value});
    for (json& one : value)
        if (one.is_string()) one = {{"image", one}};
}

}  // namespace

void write_out_short_forms(json& root) {
    if (!root.is_object()) return;
    if (root.contains("result") && root["result"].is_object()) root["result"] = json::array({root["result"]});
    if (root.contains("limits") && root["limits"].is_string()) root["limits"] = {{"api", root["limits"]}};
    if (!root.contains("passes") || !root["passes"].is_array()) return;
    for (json& pass : root["passes"]) write_out(pass, "reads"), write_out(pass, "writes");
}

void read_passes(JsonObject& root, const KnownValues& known, Technique& technique) {
    for (JsonObject& image : root.objects("images")) technique.images.push_back(read_image(std::move(image), known));
    for (JsonObject& buffer : root.objects("buffers"))
        technique.buffers.push_back(read_buffer(std::move(buffer), known));
    root.any("passes");
    for (const char* key : {"result", "reflects"})
        if (technique.resolve && root.has(key))
            fail(root.at(key), ": a technique with a 'resolve' has no '", key, "': the resolve decides that");
    if (!technique.resolve) root.any("result");
    for (JsonObject& pass : root.objects("passes"))
        technique.passes.push_back(read_pass(std::move(pass), technique, known));
    for (JsonObject& result : root.objects("result"))
        technique.results.push_back(read_result(std::move(result), known));
    if (technique.results.empty() && !technique.resolve) fail(root.at("result"), ": 'result' is empty");
    if (root.has("random")) {
        const json& random = root.any("random");
        technique.draws_random_numbers = random == true    ? Condition()
                                         : random == false ? Condition::never()
                                                           : Condition(root, "random", known);
    }
    if (root.has("limits")) technique.limits = read_limits(root.object("limits"), known);
    if (root.has("reflects")) technique.reflects = read_limit(root.object("reflects"), technique);
}
