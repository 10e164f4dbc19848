#include "core/scene/scene_file.h"

#include "core/error.h"
#include "core/json.h"
#include "core/near_miss.h"
#include "core/scene/camera_planes.h"
#include "core/scene/camera_reader.h"
#include "core/scene/content_hash.h"
#include "core/scene/gltf/load_gltf.h"
#include "core/scene/latlong_image.h"
#include "core/scene/load_scene.h"
#include "core/scene/material_override.h"
#include "core/scene/ranges.h"
#include "core/scene/texture_slots.h"
#include "core/scene/unique_names.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace fs = std::filesystem;

namespace {
template <class T>
void append(std::vector<T>& list, std::vector<T>& more) {
    list.insert(list.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// Appends all that `other` draws, lights and animates to `scene`, with its cameras and warnings.
void merge(Scene& scene, Scene other) {
    const auto textures = int(scene.textures.size()), nodes = int(scene.nodes.size()), skins = int(scene.skins.size());
    const auto materials = unsigned(scene.materials.size()), meshes = unsigned(scene.meshes.size());
    for (Material& material : other.materials) {
        for (TextureSlot* slot : texture_slots(material))
            if (slot->texture >= 0) slot->texture += textures;
        if (material.occlusion_texture.texture >= 0) material.occlusion_texture.texture += textures;
    }
    for (Mesh& mesh : other.meshes) mesh.material += materials;
    for (Node& node : other.nodes)
        if (node.parent >= 0) node.parent += nodes;
    for (Skin& skin : other.skins)
        for (unsigned& joint : skin.joints) joint += unsigned(nodes);
    for (Instance& instance : other.instances) {
        instance.mesh += meshes, instance.node += unsigned(nodes);
        if (instance.skin >= 0) instance.skin += skins;
        if (instance.weights_node >= 0) instance.weights_node += nodes;
    }
    for (AnimationChannel& channel : other.animation) channel.node += unsigned(nodes);
    for (PunctualLight& light : other.lights)
        if (light.node >= 0) light.node += nodes;
    for (SceneCamera& camera : other.cameras)
        if (camera.node >= 0) camera.node += nodes;
    append(scene.textures, other.textures);
    append(scene.materials, other.materials);
    append(scene.meshes, other.meshes);
    append(scene.nodes, other.nodes);
    append(scene.skins, other.skins);
    append(scene.instances, other.instances);
    append(scene.animation, other.animation);
    append(scene.clips, other.clips);
    append(scene.lights, other.lights);
    append(scene.cameras, other.cameras);
    make_names_unique(scene.cameras);
    for (SceneWarning& warning : other.warnings) {
        if (warning.material >= 0) warning.material += int(materials);
        if (warning.node >= 0) warning.node += nodes;
    }
    append(scene.warnings, other.warnings);
    scene.memory.take(other.memory);
    scene.frame_count = std::max(scene.frame_count, other.frame_count);
}

/// The value if each part is within +-any_radiance.
glm::vec3 checked_radiance(glm::vec3 radiance, const std::string& what) {
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(radiance[c]) <= any_radiance))
            fail(what, " has the part ", radiance[c], " outside of [", -any_radiance, ", ", any_radiance, "]");
    return radiance;
}

/// The lights of glTF files in the unit that scene.json says: then nothing remains to be said of units.
void scale_lights(Scene& scene, float factor) {
    for (PunctualLight& light : scene.lights)
        light.intensity =
            checked_radiance(light.intensity * factor,
                             "light '" + shortened(light.name) + "': the product of its intensity and 'light_scale'");
    std::erase_if(scene.warnings,
                  [](const SceneWarning& w) { return w.text.find("light_scale") != std::string::npos; });
}

/// A file named in scene.json: beside it, or in a folder of the search path, or below one of these.
fs::path find_file(const std::string& name, const fs::path& scene_file, const std::vector<fs::path>& search_path,
                   const std::string& where) {
    std::vector<fs::path> folders = {scene_file.parent_path()};
    folders.insert(folders.end(), search_path.begin(), search_path.end());
    std::error_code error;  // a name too long for the file system is just not there
    for (const fs::path& folder : folders)
        if (fs::exists(folder / name, error)) return file_below(folder, name, where);
    fail(where, ": '", shortened(name),
         "' is neither beside that file nor in the scene search path; name its folder with --scene-path or "
         "SSRLAB_SCENE_PATH");
}

glm::vec3 read_color(JsonObject& object, const std::string& key, glm::vec3 fallback) {
    const glm::vec3 color = object.vector(key, fallback);
    if (!(color.x >= 0 && color.y >= 0 && color.z >= 0))
        fail(object.where(), ": '", key, "' has a negative part; light and colours are at least 0");
    return checked_radiance(color, object.where() + ": '" + key + "'");
}

PunctualLight read_light(JsonObject object) {
    PunctualLight light;
    const std::string type = object.text("type");
    const std::vector<std::string> types = {"directional", "point", "spot"};
    if (std::ranges::find(types, type) == types.end())
        fail(object.where(), ": 'type' = \"", type, "\" is not known", suggestion(type, types));
    light.type = type == "directional" ? LightType::directional : type == "point" ? LightType::point : LightType::spot;
    light.name = object.text("name", type);
    const float strength =
        object.number(light.type == LightType::directional ? "irradiance" : "intensity", 0.0f, any_radiance);
    light.intensity = checked_radiance(strength * read_color(object, "color", glm::vec3(1.0f)),
                                       object.where() + ": the product of 'color' and strength");
    if (light.type != LightType::point) light.direction = read_direction(object, "direction");
    if (light.type != LightType::directional) {
        light.position = read_position(object, "position");
        light.range = object.number("range", 0.0f, any_length, 0.0f);
    }
    if (light.type == LightType::spot) {
        const float outer = object.number("outer_cone_deg", 0.1f, 90.0f, 45.0f),
                    inner = object.number("inner_cone_deg", 0.0f, outer, 0.0f);
        light.inner_cone_cos = std::cos(glm::radians(inner)), light.outer_cone_cos = std::cos(glm::radians(outer));
    }
    object.finish();
    return light;
}

}  // namespace

Environment read_environment(JsonObject object, const fs::path& scene_file, const std::vector<fs::path>& search_path,
                             std::vector<std::string>& notes) {
    Environment environment;
    if (object.has("gradient")) {
        JsonObject gradient = object.object("gradient");
        environment.type = Environment::Type::gradient;
        environment.color = checked_radiance(gradient.vector("color"), gradient.where() + ": 'color'");
        environment.slope = checked_radiance(gradient.vector("slope"), gradient.where() + ": 'slope'");
        if (gradient.has("axis")) environment.axis = read_direction(gradient, "axis");
        gradient.finish();
    } else if (object.has("image")) {
        environment.type = Environment::Type::image;
        environment.rotation = glm::radians(object.number("rotation_deg", -3600.0f, 3600.0f, 0.0f));
        const float scale = object.number("scale", 0.0f, 1e9f, 1.0f);
        environment.latlong =
            read_latlong(find_file(object.text("image"), scene_file, search_path, object.where()), scale, notes);
    } else {
        environment.color = read_color(object, "constant", glm::vec3(0.0f));
        if (!object.has("constant")) fail(object.where(), " names no kind: give 'constant', 'gradient' or 'image'");
    }
    object.finish();
    return environment;
}

void finish_scene(Scene& scene) {
    for (SceneCamera& camera : scene.cameras)
        if (camera.far == 0.0f) camera.far = std::max(derive_far(camera, scene), 2.0f * camera.near);
    std::set<std::string_view> names;
    for (const SceneCamera& camera : scene.cameras)
        if (!names.insert(camera.name).second)
            fail("scene '", scene.name, "' has two cameras named '", shortened(camera.name), "'");
    scene.content_hash = content_hash(scene);
}

Scene load_scene_file(const fs::path& file, const std::vector<fs::path>& search_path, GltfChoices choices) {
    const JsonDocument document = read_json_document(file);
    JsonObject object(document, file.string());
    Scene scene;
    const std::string animation = object.text("animation", "");
    if (choices.animation.empty()) choices.animation = animation;
    const fs::path gltf =
        object.has("gltf") ? find_file(object.text("gltf"), file, search_path, file.string()) : fs::path();
    choices.draws_blended_opaque |= object.value_of<bool>("blended", {{"cut", false}, {"opaque", true}});
    GltfChoices choices_of_gltf = choices;
    choices_of_gltf.material_variant = object.text("material_variant", "");
    if (gltf.empty() && !choices_of_gltf.material_variant.empty())
        fail(object.at("material_variant"), " chooses among the variants of 'gltf', which is not given");
    if (!gltf.empty()) scene = load_gltf(gltf, choices_of_gltf);
    if (object.has("also")) {
        const nlohmann::json& also = object.any("also");
        const bool is_list = also.is_array() && std::ranges::all_of(also, [](const auto& v) { return v.is_string(); });
        if (!is_list) fail(file.string(), ": 'also' must be an array of file names, not ", also.dump());
        for (const nlohmann::json& name : also)
            merge(scene, load_gltf(find_file(name.get<std::string>(), file, search_path, file.string()), choices));
    }
    if (object.has("light_scale")) scale_lights(scene, object.number("light_scale", 0.0f, 1e9f));
    scene.name = fs::absolute(file).parent_path().filename().string();
    const bool is_own = gltf.empty() || fs::absolute(gltf).parent_path() == fs::absolute(file).parent_path();
    check_animation(scene, choices.animation);
    scene.asset = is_own ? scene.name : gltf.filename().string();
    std::vector<std::string> notes;
    if (object.has("environment"))
        scene.environment = read_environment(object.object("environment"), file, search_path, notes);
    for (std::string& note : notes) scene.warnings.push_back({.text = std::move(note)});
    scene.memory.add(double(scene.environment.latlong.values.size()) * sizeof(float),
                     file.string() + ": 'environment'");
    for (JsonObject& light : object.objects("lights")) scene.lights.push_back(read_light(light));
    ChangedTexels changed;
    for (JsonObject& entry : object.objects("overrides")) apply_override(entry, scene, changed);

    scene.frame_count = unsigned(object.integer("frame_count", 1, 1000000, int(scene.frame_count)));
    scene.frame_rate = object.number("frame_rate", 1e-3f, 1e6f, scene.frame_rate);
    scene.draws_backs = object.choice("back_faces", {"culled", "drawn"}, "culled") == "drawn";
    std::vector<SceneCamera> cameras;
    for (JsonObject& camera : object.objects("cameras")) cameras.push_back(read_camera(camera, scene));
    if (!cameras.empty()) scene.cameras = std::move(cameras);
    if (scene.cameras.empty()) fail(file.string(), ": no camera: name at least one under 'cameras'");
    object.finish();
    finish_scene(scene);
    return scene;
}
