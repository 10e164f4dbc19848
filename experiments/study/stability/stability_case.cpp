#include "experiments/study/stability/stability_case.h"

#include "core/error.h"
#include "core/json_float.h"
#include "core/own_files.h"
#include "core/reading_limits.h"
#include "core/scene/ranges.h"
#include "experiments/study/config/points/point_name.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

const std::vector<std::pair<std::string, DepthFormat>> depth_formats = {
    {"d32f", DepthFormat::d32f}, {"d24", DepthFormat::d24}, {"d16", DepthFormat::d16}};

glm::uvec2 read_size(JsonObject& object, const std::string& key, glm::uvec2 fallback) {
    if (!object.has(key)) return fallback;
    const nlohmann::json& size = object.any(key);
    const auto is_side = [](const nlohmann::json& side) { return is_whole(side) && side >= 1u && side <= 65536u; };
    if (!size.is_array() || size.size() != 2 || !is_side(size[0]) || !is_side(size[1]))
        fail(object.where(), ": '", key, "' must be [width, height] in pixels from 1 to 65536, not ", shown(size));
    return {size[0].get<unsigned>(), size[1].get<unsigned>()};
}

std::vector<unsigned> read_poses(JsonObject& object) {
    if (!object.has("poses")) return std::vector<unsigned>(size_t(object.integer("frames", 1, 100000, 3)), 0u);
    const nlohmann::json& poses = object.any("poses");
    const bool is_list = poses.is_array() && !poses.empty() && std::ranges::all_of(poses, [](const auto& pose) {
                             return is_whole(pose) && pose >= 0 && pose <= std::numeric_limits<unsigned>::max();
                         });
    if (!is_list) fail(object.where(), ": 'poses' must be an array of frame numbers, not ", shown(poses));
    return poses.get<std::vector<unsigned>>();
}

/// A factor for each axis, with sign. Its size is in [least, any_length].
glm::vec3 read_factors(JsonObject& object, const std::string& key, float least) {
    const glm::vec3 factors = object.vector(key, glm::vec3(1.0f));
    for (int axis = 0; axis < 3; ++axis)
        if (const float size = std::abs(factors[axis]); !(size >= least && size <= any_length))
            fail(object.at(key), ": '", key, "' has the factor ", factors[axis], ", whose size is outside of [", least,
                 ", ", any_length, "]");
    return factors;
}

void read_scale(JsonObject& object, CaseScene& scene) {
    if (!object.has("scale")) return;
    scene.scales_all = object.any("scale").is_number();
    scene.scale =
        scene.scales_all ? glm::vec3(object.number("scale", 1e-9f, any_length)) : read_factors(object, "scale", 0.0f);
}

CaseScene read_scene(JsonObject& object) {
    CaseScene scene;
    ShotConfig& shot = scene.shot;
    shot.scene = object.text("scene");
    shot.camera = object.text("camera", "");
    shot.extent = read_size(object, "size", shot.extent);
    shot.frames = read_poses(object);
    shot.depth_format = object.value_of("depth_format", depth_formats);
    if (object.boolean("reversed_depth", false)) shot.depth_direction = DepthDirection::reversed;
    shot.direct_lit = object.choice("lit", {"path_traced", "direct"}, "path_traced") == "direct";
    if (object.has("near")) scene.near = object.number("near", 1e-6f, 1e9f);
    if (object.has("far")) scene.far = object.number("far", 1e-6f, 1e12f);
    read_scale(object, scene);
    scene.instance_scale = read_factors(object, "instance_scale", 1e-9f);  // meshes are divided by it
    if (object.has("roughness")) scene.roughness = object.number("roughness", 0.0f, 1.0f);
    scene.radiance = object.number("radiance", 0.0f, 1e12f, 1.0f);
    if (object.has("view")) scene.view = object.any("view");
    if (object.has("quads")) scene.quads = object.any("quads");
    scene.where = object.where();
    return scene;
}

/// JSON has no name for what is no number.
float read_value(const nlohmann::json& value, const std::string& where) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    if (value.is_number()) return float_of(value, where);
    if (value == "nan") return std::numeric_limits<float>::quiet_NaN();
    if (value == "inf") return infinity;
    if (value == "-inf") return -infinity;
    if (value == "denormal") return std::numeric_limits<float>::denorm_min();
    fail(where, " must be a number, \"nan\", \"inf\", \"-inf\" or \"denormal\", not ", shown(value));
}

/// One number for both, or two.
glm::vec2 read_pair(JsonObject& object, const std::string& key) {
    const nlohmann::json& pair = object.any(key);
    const std::string where = object.at(key) + ": '" + key + "'";
    if (!pair.is_array()) return glm::vec2(read_value(pair, where));
    if (pair.size() != 2) fail(where, " must be one value or two, not ", shown(pair));
    return {read_value(pair[0], where), read_value(pair[1], where)};
}

InputFault read_fault(JsonObject object) {
    InputFault fault;
    object.any("image");  // which is required
    fault.image = object.value_of("image", input_images());
    const char* key = object.has("times") ? "times" : "value";
    fault.is_factor = object.has("times");
    const nlohmann::json& value = object.any(key);
    for (const nlohmann::json& channel : value.is_array() ? value : nlohmann::json::array({value}))
        fault.value.push_back(read_value(channel, object.at(key) + ": '" + key + "'"));
    if (fault.value.empty() || fault.value.size() > 4)
        fail(object.at(key), ": '", key, "' must be one value, or one for each of up to 4 channels, not ",
             shown(value));
    fault.where = object.choice("where", {"pixel", "all", "every_other"}, "pixel");
    if (object.has("at")) fault.at = read_pair(object, "at");
    if (!(fault.at.x >= 0 && fault.at.x <= 1 && fault.at.y >= 0 && fault.at.y <= 1))
        fail(object.at("at"), ": 'at' must be in [0, 1], not ", shown(object.any("at")));
    if (object.has("step")) fault.step = unsigned(object.integer("step", 0, 100000));
    object.finish();
    return fault;
}

MetricImages read_images(JsonObject object) {
    MetricImages images;
    images.size = read_size(object, "size", images.size);
    constexpr double bytes_a_pixel = 160;  // measured: 139, of the metric that takes most
    MemoryShare().add(bytes_a_pixel * images.size.x * images.size.y,
                      message_text(object.where(), ": ", images.size.x, " x ", images.size.y, " pixels"));
    images.reference = read_pair(object, "reference"), images.test = read_pair(object, "test");
    object.finish();
    return images;
}

/// The keys of a case that say what is drawn, and stay in what it is compared with.
bool stays_in_benign(const std::string& key) {
    return key == "scene" || key == "camera" || key == "size" || key == "poses" || key == "frames" || key == "view" ||
           key == "quads" || key == "lit";
}

StabilityCase read_case(const nlohmann::json& json, const std::string& where) {
    JsonObject object(json, where);
    StabilityCase result;
    result.name = object.text("case"), result.family = object.text("family", result.name);
    result.group = object.text("group"), result.why = object.text("why");
    if (object.has("images")) {
        result.images = read_images(object.object("images"));
        object.finish();
        return result;
    }
    result.scene = read_scene(object);
    for (JsonObject& fault : object.objects("faults")) result.faults.push_back(read_fault(std::move(fault)));
    if (object.has("size_before")) result.size_before = read_size(object, "size_before", {});
    result.feeds_back = object.boolean("feeds_back", false);
    result.is_perturbed = object.boolean("perturbed", false);
    result.is_truth_same = object.boolean("same_truth", false);
    result.only = object.texts("only");

    nlohmann::json benign = nlohmann::json::object();
    for (const auto& [key, value] : json.items())
        if (stays_in_benign(key)) benign[key] = value;
    if (object.has("benign")) object.object("benign"), benign.merge_patch(object.any("benign"));
    object.finish();
    result.benign_key = benign.dump();
    JsonObject benign_object(benign, where + ": 'benign'");
    result.benign = read_scene(benign_object);
    benign_object.finish();
    return result;
}

/// A value of `each` as the case's name has it.
std::string label_of_value(const std::string& key, const nlohmann::json& value, const std::string& where) {
    if (value.is_object() && value.contains("name")) return JsonObject(value, where).text("name");
    if (key != "faults") return label_of({{key, value}});
    const nlohmann::json faults = {{key, value}};
    std::string label;
    for (JsonObject& fault : JsonObject(faults, where).objects(key)) {
        for (const char* known : {"image", "times", "value", "where", "at", "step"}) fault.has(known);
        label += (label.empty() ? "" : ", ") + fault.text("image") + " " +
                 plain_text(fault.any(fault.has("times") ? "times" : "value")) +
                 (fault.has("at") ? " at " + fault.any("at").dump() : "");
    }
    return label;
}

/// Sets aside what all combinations of `each` take, before one is made.
void set_combinations_aside(const nlohmann::json& json, const std::string& where, MemoryShare& memory) {
    constexpr double bytes_per_case = 4096, bytes_per_character = 32;  // as a document, twice, and as a StabilityCase
    double count = 1;
    if (json.is_object() && json.contains("each"))
        for (const nlohmann::json& values : json["each"]) count *= double(values.size());
    memory.add(count * (bytes_per_case + bytes_per_character * double(json.dump().size())), where + ": 'each'");
}

/// Every combination of the values of `each`.
std::vector<nlohmann::json> expanded(nlohmann::json json, const std::string& where) {
    JsonObject object(json, where);
    if (!object.has("each")) return {json};
    object.object("each");  // which it must be
    const nlohmann::json each = json["each"];
    std::vector<std::pair<nlohmann::json, std::string>> cases = {{json, object.text("case")}};
    cases.front().first.erase("each");
    for (const auto& [key, values] : each.items()) {
        if (!values.is_array() || values.empty())
            fail(where, ": each: '", key, "' must be an array of one value or more, not ", shown(values));
        std::vector<std::pair<nlohmann::json, std::string>> more;
        for (const auto& [base, name] : cases)
            for (const nlohmann::json& value : values) {
                nlohmann::json next = base;
                next[key] = value;
                more.emplace_back(next, name + " " + label_of_value(key, value, where + ": each"));
            }
        cases = std::move(more);
    }
    std::vector<nlohmann::json> result;
    for (auto& [base, name] : cases) {
        base["family"] = base["case"], base["case"] = name;
        result.push_back(std::move(base));
    }
    return result;
}

}  // namespace

const std::vector<std::pair<std::string, HostImage HostGBuffer::*>>& input_images() {
    using G = HostGBuffer;
    static const std::vector<std::pair<std::string, HostImage G::*>> images = {
        {"depth", &G::depth},
        {"geometric_normal", &G::geometric_normal},
        {"normal", &G::normal},
        {"base_color", &G::base_color},
        {"emission", &G::emission},
        {"motion", &G::motion},
        {"previous_depth", &G::previous_depth},
        {"previous_normal", &G::previous_normal},
        {"lit", &G::lit},
        {"fallback", &G::fallback}};
    return images;
}

std::vector<StabilityCase> read_stability_cases(const std::filesystem::path& file) {
    const nlohmann::json table = read_json(file);
    JsonObject object(table, file.string());
    const nlohmann::json& entries = object.any("cases");
    object.finish();
    if (!entries.is_array()) fail(file.string(), ": 'cases' must be an array");
    std::vector<StabilityCase> cases;
    MemoryShare memory;
    for (size_t i = 0; i < entries.size(); ++i) {
        const std::string where = file.string() + ": cases[" + std::to_string(i) + "]";
        set_combinations_aside(entries[i], where, memory);
        for (const nlohmann::json& entry : expanded(entries[i], where)) cases.push_back(read_case(entry, where));
    }
    return cases;
}

bool StabilityCase::has_truth() const {
    return !scene.shot.direct_lit &&
           std::ranges::all_of(faults, [](const InputFault& f) { return f.where == "pixel" || f.is_factor; });
}

std::filesystem::path stability_case_table() { return own_files() / "experiments/study/stability/cases.json"; }
