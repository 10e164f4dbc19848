#include "variants/passes/read_passes.h"

#include "core/error.h"
#include "core/gpu/pipelines/shader.h"
#include "core/json_float.h"
#include "core/near_miss.h"
#include "variants/common/names.h"
#include "variants/passes/declared_passes.h"
#include "variants/passes/read_images.h"

#include <algorithm>

namespace {

using nlohmann::json;

void read_mip(JsonObject& object, DeclaredUse& use) {
    if (!object.has("mip")) return;
    using Mips = DeclaredUse::Mips;
    if (object.any("mip").is_string()) {
        use.mips = object.value_of<Mips>("mip", {{"current", Mips::current}, {"finer", Mips::finer}});
    } else {
        use.mips = Mips::one;
        use.mip = unsigned(object.integer("mip", 0, most_mips - 1));
    }
}

DeclaredUse read_use(JsonObject object, bool is_read, const KnownValues& known) {
    know_keys(object, {"image", "as", "mip", "when"});
    if (is_read) know_keys(object, {"linear", "wrap_u", "wrap_v"});
    DeclaredUse use;
    use.is_in_place = !is_read && object.boolean("in_place", false);
    use.place = object.at("image");
    use.image = object.text("image");
    use.as = variable_name(object, "as", use.image);
    read_mip(object, use);
    use.when = Condition(object, "when", known);
    if (is_read) {
        const std::vector<std::pair<std::string, Wrap>> wraps = {
            {"clamp", Wrap::clamp}, {"repeat", Wrap::repeat}, {"mirrored_repeat", Wrap::mirrored_repeat}};
        use.is_linear = Condition::or_truth(object, "linear", known);
        use.wrap_u = object.value_of("wrap_u", wraps), use.wrap_v = object.value_of("wrap_v", wraps);
    }
    object.finish();
    return use;
}

/// Of `depth` or of `stencil`.
DeclaredTest read_test(JsonObject object, bool is_depth, const KnownValues& known) {
    know_keys(object, {"image", "write", "when"});
    DeclaredTest test;
    test.place = object.at("image");
    test.image = object.text("image");
    test.when = Condition(object, "when", known);
    if (is_depth) {
        using Compare = DepthTest::Compare;
        test.compare = object.value_of<Compare>("compare", {{"less", Compare::less},
                                                            {"greater", Compare::greater},
                                                            {"less_or_equal", Compare::less_or_equal},
                                                            {"greater_or_equal", Compare::greater_or_equal},
                                                            {"equal", Compare::equal},
                                                            {"always", Compare::always}});
        test.is_written = object.boolean("write", false);
    } else {
        test.is_written = object.has("write");
        if (test.is_written == object.has("equal"))
            fail(test.place, ": 'stencil' has either a value to 'write', or one that is 'equal' where to draw");
        test.mode = test.is_written ? Stencil::Mode::write : Stencil::Mode::keep_equal;
        test.value = unsigned(object.integer(test.is_written ? "write" : "equal", 0, 255));
    }
    object.finish();
    return test;
}

/// Whole numbers are int or uint, others float, four numbers vec4.
PushValue read_push_value(const json& value, const std::string& where) {
    if (value == "current_mip") return MipValue{};
    if (value.is_object() && value.size() == 1 && value.value("last_mip_of", json()).is_string())
        return MipValue{value["last_mip_of"]};
    if (value.is_number_integer() && value >= -0x1p31 && value < 0x1p32)
        return int(uint32_t(value.get<int64_t>()));  // the same bits in both types
    if (value.is_number_float()) return float_of(value, where);
    const auto is_number = [](const json& one) { return one.is_number(); };
    if (!value.is_array() || value.size() != 4 || !std::ranges::all_of(value, is_number))
        fail(where, ": must be a whole number (int, uint), one with a point (float), or an array of four (vec4), not ",
             shown(value));
    glm::vec4 vector;
    for (int i = 0; i < 4; ++i) vector[i] = float_of(value[size_t(i)], where);
    return vector;
}

void read_rays(JsonObject& object, const Declaration& declaration, DeclaredPass& pass) {
    if (!object.has("rays")) return;
    if (!object.any("rays").is_string()) {
        pass.rays = unsigned(object.integer("rays", 1, 64));
        return;
    }
    std::vector<std::string> counts;
    for (const Parameter& p : declaration.parameters)
        if (p.choices.empty() && (p.glsl_type == "uint" || p.glsl_type == "int") && p.min >= 1 && p.max <= 64)
            counts.push_back(p.name);
    if (declaration.denoiser) counts.push_back("max_rays");
    pass.rays_parameter = object.text("rays");
    if (!std::ranges::count(counts, pass.rays_parameter))
        fail(object.at("rays"), ": 'rays' names '", shortened(pass.rays_parameter),
             "', which is no parameter of whole numbers in [1, 64]", suggestion(pass.rays_parameter, counts));
}

std::map<std::string, Condition> read_scene_constants(JsonObject object, const KnownValues& known) {
    std::map<std::string, Condition> found;
    for (const char* name : {"scene_is_still", "scene_has_environment", "scene_has_matte"})
        if (object.has(name)) found[name] = Condition::or_truth(object, name, known);
    object.finish();
    return found;
}

/// An image or a buffer that is filled with a value, without a shader.
void read_clear(JsonObject& object, const KnownValues& known, DeclaredPass& pass) {
    know_keys(object, {"value", "when"});
    pass.cleared = object.text("clear");
    pass.stage = "clear";
    pass.set["value"] = glm::vec4(0);
    if (!object.has("value")) return;
    const json& value = object.any("value");
    if (value.is_string() && known.by_name().contains(value) && known.by_name()[value.get<std::string>()].is_number())
        pass.cleared_to = value;
    else
        pass.set["value"] = read_push_value(value, object.at("value") + ": 'value'");
}

/// Of a pass, or of one of its `forms`.
DeclaredForm read_form(JsonObject& object) {
    know_keys(object, {"shader", "groups", "pixels_per_group", "arguments", "arguments_at"});
    DeclaredForm form;
    form.shader = object.text("shader");
    if (!form.is_compute() && !form.shader.ends_with(".frag"))
        fail(object.at("shader"), ": 'shader' = '", shortened(form.shader),
             "' must end in .comp, a compute shader, or in .frag, a fragment shader over the whole image");
    form.groups = read_size(object, "groups");
    form.pixels_per_group = read_size(object, "pixels_per_group");
    form.arguments = object.text("arguments", "");
    form.arguments_at = unsigned(object.integer("arguments_at", 0, most_bytes, 0));
    for (const char* key : {"groups", "pixels_per_group", "arguments"})
        if (object.has(key) && !form.is_compute())
            fail(object.at(key), ": a fragment shader runs over the images that it writes");
    return form;
}

void read_forms(JsonObject& object, const KnownValues& known, DeclaredPass& pass) {
    if (!object.has("forms")) {
        pass.forms.push_back(read_form(object));
        return;
    }
    for (JsonObject& of_form : object.objects("forms")) {
        pass.forms.push_back(read_form(of_form));
        pass.forms.back().when = Condition(of_form, "when", known);
        of_form.finish();
        if (pass.forms.back().is_compute() != pass.is_compute())
            fail(of_form.where(), ": the forms of a pass are all compute shaders, or all fragment shaders");
    }
    if (pass.forms.empty() || !pass.forms.back().when.is_always())
        fail(object.at("forms"), ": the last of 'forms' must have no condition");
}

std::vector<DeclaredExtent> read_over(JsonObject& object, const KnownValues& known) {
    std::vector<DeclaredExtent> all;
    for (JsonObject& one : object.objects("over")) {
        DeclaredExtent extent{.image = one.text("image", ""), .share = {}, .when = Condition(one, "when", known)};
        if (extent.image.empty()) extent.share = read_share(one);
        one.finish();
        all.push_back(extent);
    }
    return all;
}

std::vector<DeclaredInclude> read_includes(JsonObject& object, const KnownValues& known) {
    std::vector<DeclaredInclude> all;
    for (JsonObject& one : object.objects("includes")) {
        know_keys(one, {"name", "file", "needs", "when"});
        DeclaredInclude include{.name = variable_name(one, "name"), .file = one.text("file"), .when = {}};
        if (one.has("needs")) include.needs_half_floats = one.value_of<bool>("needs", {{"half_floats", true}});
        include.when = Condition(one, "when", known);
        one.finish();
        all.push_back(include);
    }
    return all;
}

std::vector<DeclaredLeftOut> read_left_out(JsonObject& object, const KnownValues& known) {
    std::vector<DeclaredLeftOut> all;
    for (JsonObject& one : object.objects("left_out")) {
        know_keys(one, {"part", "when", "fact", "why", "keeps_bits", "constants"});
        DeclaredLeftOut left_out{.part = one.text("part", ""), .fact = one.text("fact"), .why = one.text("why")};
        one.any("when");
        left_out.when = Condition(one, "when", known);
        left_out.keeps_bits = one.boolean("keeps_bits", true);
        if (one.has("constants")) {
            JsonObject constants = one.object("constants");
            for (const auto& [name, value] : one.any("constants").items()) {
                if (!known.by_name().contains(name))
                    fail(constants.at(name), ": '", shortened(name), "' is no parameter");
                left_out.constants[name] = uint32_t(constants.boolean(name, false));
            }
        }
        one.finish();
        all.push_back(left_out);
    }
    return all;
}

/// Those of the technique, of one with a denoiser, and of a denoiser.
void check_buffers(JsonObject& object, const std::string& key, const std::vector<std::string>& named,
                   const Declaration& declaration) {
    std::vector<std::string> names;
    if (declaration.denoiser || declaration.is_denoiser) names = ray_buffers;
    if (declaration.is_denoiser) names.push_back(seen_rays_buffer);
    std::ranges::move(names_of(declaration.buffers, &DeclaredBuffer::name), std::back_inserter(names));
    for (const std::string& buffer : named)
        if (!std::ranges::count(names, buffer))
            fail(object.at(key), ": there is no buffer '", shortened(buffer), "'", suggestion(buffer, names));
}

void read_shader(JsonObject& object, const Declaration& declaration, const KnownValues& known, DeclaredPass& pass) {
    know_keys(object,
              {"shader", "forms", "stage", "reads", "writes", "depth", "stencil", "buffers", "tracers", "rays", "over",
               "each_mip_of", "first_mip", "includes", "set", "environment", "scene_constants", "left_out", "when"});
    read_forms(object, known, pass);
    if (object.has("stage")) pass.stage = variable_name(object, "stage");
    for (JsonObject& read : object.objects("reads")) pass.reads.push_back(read_use(std::move(read), true, known));
    for (JsonObject& write : object.objects("writes")) pass.writes.push_back(read_use(std::move(write), false, known));
    for (JsonObject& test : object.objects("depth")) pass.depth.push_back(read_test(std::move(test), true, known));
    for (JsonObject& test : object.objects("stencil")) pass.stencil.push_back(read_test(std::move(test), false, known));
    for (const auto* tests : {&pass.depth, &pass.stencil})
        if (!tests->empty() && pass.is_compute())
            fail(tests->front().place, ": only a fragment shader is tested by depth or stencil");
    pass.buffers = object.texts("buffers");
    check_buffers(object, "buffers", pass.buffers, declaration);
    for (const DeclaredForm& form : pass.forms)
        if (!form.arguments.empty())
            check_buffers(object, object.has("forms") ? "forms" : "arguments", {form.arguments}, declaration);
    pass.tracers = object.texts("tracers");
    for (const std::string& slot : pass.tracers) {
        const std::vector<std::string> names = names_of(declaration.slots, &TracerSlot::name);
        if (!std::ranges::count(names, slot))
            fail(object.at("tracers"), ": 'tracers' has no slot '", shortened(slot), "'", suggestion(slot, names));
    }
    read_rays(object, declaration, pass);
    pass.over = read_over(object, known);
    if (!pass.over.empty() && !pass.is_compute())
        fail(object.at("over"), ": a fragment shader runs over the images that it writes");
    pass.each_mip_of = object.text("each_mip_of", "");
    if (!pass.each_mip_of.empty()) pass.first_mip = unsigned(object.integer("first_mip", 0, most_mips, 1));
    pass.includes = read_includes(object, known);
    if (object.has("set")) {
        const JsonObject values = object.object("set");
        for (const auto& [name, value] : object.any("set").items())
            pass.set[name] = read_push_value(value, values.at(name) + ": '" + shortened(name) + "'");
    }
    pass.has_environment = object.boolean("environment", false);
    if (object.has("scene_constants"))
        pass.scene_constants = read_scene_constants(object.object("scene_constants"), known);
    pass.left_out = read_left_out(object, known);
}

DeclaredPass read_pass(JsonObject object, const Declaration& declaration, const KnownValues& known) {
    DeclaredPass pass;
    pass.place = object.where();
    if (object.has("clear"))
        read_clear(object, known, pass);
    else
        read_shader(object, declaration, known, pass);
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

RoughnessLimit read_limit(JsonObject object, const Declaration& declaration, const KnownValues& known) {
    know_keys(object, {"up_to", "below", "of", "bits", "when"});
    RoughnessLimit limit;
    limit.is_alpha = object.value_of<bool>("of", {{"roughness", false}, {"alpha", true}});
    limit.is_of_8_bits = object.has("bits") && object.integer("bits", 8, 8) == 8;
    limit.when = Condition(object, "when", known);
    limit.is_excluded = object.has("below");
    const std::string key = limit.is_excluded ? "below" : "up_to";
    limit.parameter = object.text(key);
    std::vector<std::string> numbers;
    for (const Parameter& p : declaration.parameters)
        if (p.glsl_type == "float") numbers.push_back(p.name);
    if (!std::ranges::count(numbers, limit.parameter))
        fail(object.at(key), ": '", key, "' names '", shortened(limit.parameter), "', which is no float parameter",
             suggestion(limit.parameter, numbers));
    object.finish();
    return limit;
}

TechniqueLimits read_limits(JsonObject object, const KnownValues& known) {
    know_keys(object, {"api", "lifted_by"});
    TechniqueLimits limits;
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

/// Makes an array of a member that may be one value, and objects of names.
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
    for (const char* key : {"result", "reflects"}) write_out(root, key);
    if (root.contains("limits") && root["limits"].is_string()) root["limits"] = {{"api", root["limits"]}};
    if (!root.contains("passes") || !root["passes"].is_array()) return;
    for (json& pass : root["passes"])
        for (const char* key : {"reads", "writes", "depth", "stencil", "over", "includes", "left_out"})
            write_out(pass, key);
}

void read_passes(JsonObject& root, KnownValues known, Declaration& declaration) {
    for (JsonObject& object : root.objects("conditions")) {
        const std::string name = variable_name(object, "name");
        if (known.by_name().contains(name))
            fail(object.at("name"), ": there is a parameter or a condition '", name, "' already");
        object.any("when");
        declaration.conditions.push_back({name, Condition(object, "when", known)});
        known.derive(declaration.conditions);
        object.finish();
    }
    for (JsonObject& image : root.objects("images")) declaration.images.push_back(read_image(std::move(image), known));
    for (JsonObject& buffer : root.objects("buffers"))
        declaration.buffers.push_back(read_buffer(std::move(buffer), known));
    root.any("passes");
    for (const char* key : {"result", "reflects"})
        if (declaration.denoiser && root.has(key))
            fail(root.at(key), ": a technique with a 'denoiser' has no '", key, "': the denoiser decides that");
    if (!declaration.denoiser) root.any("result");
    for (JsonObject& pass : root.objects("passes"))
        declaration.passes.push_back(read_pass(std::move(pass), declaration, known));
    for (JsonObject& result : root.objects("result"))
        declaration.results.push_back(read_result(std::move(result), known));
    if (declaration.results.empty() && !declaration.denoiser) fail(root.at("result"), ": 'result' is empty");
    if (root.has("random")) declaration.draws_random_numbers = Condition::or_truth(root, "random", known);
    if (root.has("limits")) declaration.limits = read_limits(root.object("limits"), known);
    for (JsonObject& limit : root.objects("reflects"))
        declaration.reflects.push_back(read_limit(std::move(limit), declaration, known));
    declaration.not_repeatable = read_reasons(root, known);
    for (JsonObject& pyramid : root.objects("pyramids")) {
        std::vector<std::pair<std::string, std::string>> makers;
        for (const NamedPyramidMaker& maker : pyramid_makers()) makers.emplace_back(maker.name, maker.name);
        pyramid.any("made_by");
        declaration.pyramids.push_back({pyramid.value_of("made_by", makers), Condition(pyramid, "when", known)});
        pyramid.finish();
    }
}
