#include "experiments/study/stability/changed_shot.h"

#include "core/error.h"
#include "core/scene/camera_reader.h"
#include "core/scene/content_hash.h"
#include "core/scene/material_override.h"
#include "core/scene/ranges.h"

namespace {

/// A node above all others, by which everything that hangs on nodes is scaled.
void scale_nodes(Scene& scene, glm::vec3 scale) {
    for (Node& node : scene.nodes) ++node.parent;  // of roots: from -1 to the new node
    Node root{.name = "scale"};
    root.scale = scale;
    root.parent_from_node = glm::mat4(1.0f);
    for (int axis = 0; axis < 3; ++axis) root.parent_from_node[axis][axis] = scale[axis];
    scene.nodes.insert(scene.nodes.begin(), root);
    for (Skin& skin : scene.skins)
        for (unsigned& joint : skin.joints) ++joint;
    for (Instance& instance : scene.instances) ++instance.node, instance.weights_node += instance.weights_node >= 0;
    for (AnimationChannel& channel : scene.animation) ++channel.node;
    for (PunctualLight& light : scene.lights) light.node += light.node >= 0;
    for (SceneCamera& camera : scene.cameras) camera.node += camera.node >= 0;
}

/// Irradiances stay what they are: intensities grow by the square.
void scale_lights(Scene& scene, float scale) {
    for (PunctualLight& light : scene.lights) {
        if (light.type != LightType::directional) light.intensity *= scale * scale;
        light.range *= scale, light.position *= scale;
    }
}

void scale_camera(SceneCamera& camera, float scale) {
    camera.near *= scale, camera.far *= scale, camera.orthographic_height *= scale;
    for (CameraKey& key : camera.keys) key.position *= scale, key.target *= scale;
}

void brighten(Scene& scene, float factor) {
    for (Material& material : scene.materials) material.emission *= factor;
    for (PunctualLight& light : scene.lights) light.intensity *= factor;
    scene.environment.color *= factor, scene.environment.slope *= factor;
    for (float& value : scene.environment.latlong.values) value *= factor;
}

/// A mesh by the inverse of `scale`.
void unscale(Mesh& mesh, glm::vec3 scale) {
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
        Vertex& v = mesh.vertices[i];
        const float normal = glm::length(v.normal * scale), tangent = glm::length(glm::vec3(v.tangent) / scale);
        for (MorphTarget& target : mesh.targets) {
            if (!target.positions.empty()) target.positions[i] /= scale;
            if (!target.normals.empty()) target.normals[i] *= scale / normal;
            if (!target.tangents.empty()) target.tangents[i] /= scale * tangent;
        }
        v.position /= scale;
        v.normal = glm::normalize(v.normal * scale);
        v.tangent = glm::vec4(glm::normalize(glm::vec3(v.tangent) / scale), v.tangent.w);
    }
}

/// Each mesh by the inverse of `scale`, below which its instances hang: the picture stays, but the normals go through a
/// transform as ill-conditioned as the ratio of its parts.
void scale_instances(Scene& scene, glm::vec3 scale) {
    for (Mesh& mesh : scene.meshes) unscale(mesh, scale);
    for (Skin& skin : scene.skins)  // in place of the node, which does not move what joints do
        for (glm::mat4& joint_from_mesh : skin.joint_from_mesh)
            for (int axis = 0; axis < 3; ++axis) joint_from_mesh[axis] *= scale[axis];
    for (Instance& instance : scene.instances) {
        Node node{.name = "instance scale", .parent = int(instance.node)};
        node.scale = scale;
        for (int axis = 0; axis < 3; ++axis) node.parent_from_node[axis][axis] = scale[axis];
        if (instance.weights_node < 0) instance.weights_node = int(instance.node);
        instance.node = unsigned(scene.nodes.size());
        scene.nodes.push_back(node);
    }
}

/// Of 2x2 texels: the upper left and the lower right one are there.
int add_mask(Scene& scene) {
    Texture texture{.name = "mask", .extent = {2, 2}};
    std::vector<uint8_t> rgba;
    for (const uint8_t alpha : {255, 0, 0, 255}) rgba.insert(rgba.end(), {255, 255, 255, alpha});
    texture.rgba = make_texels(std::move(rgba));
    texture.wrap_u = texture.wrap_v = TextureWrap::clamp_to_edge, texture.is_nearest = true;
    scene.textures.push_back(texture);
    return int(scene.textures.size()) - 1;
}

/// {"corners": three or four points, counter-clockwise seen from the front, and the material's "roughness",
/// "metalness", "base_color", "emission"; "masked": by a board of 2x2 squares, of which that at the first corner and
/// the one across are there}.
void add_quad(Scene& scene, JsonObject quad) {
    const nlohmann::json& json = quad.any("corners");
    const auto is_point = [](const nlohmann::json& point) {
        return point.is_array() && point.size() == 3 &&
               std::ranges::all_of(point, [](const auto& v) { return v.is_number(); });
    };
    if (!json.is_array() || json.size() < 3 || json.size() > 4 || !std::ranges::all_of(json, is_point))
        fail(quad.at("corners"), ": 'corners' must be 3 or 4 points of three numbers, not ", shown(json));
    std::vector<glm::vec3> corners;
    for (const nlohmann::json& corner : json) {
        const nlohmann::json entry = {{"corner", corner}};
        JsonObject point(entry, quad.at("corners") + ": 'corners'");
        corners.push_back(read_position(point, "corner"));
    }
    // In double precision, which holds the product of the edges of the smallest triangles.
    const glm::dvec3 across = glm::cross(glm::dvec3(corners[1] - corners[0]), glm::dvec3(corners[2] - corners[0]));
    const double length = glm::length(across);
    const glm::vec3 normal = length > 0 ? glm::vec3(across / length) : glm::vec3(0, 1, 0);
    Material material{.name = "quad"};
    material.roughness = quad.number("roughness", 0.0f, 1.0f, 0.0f);
    material.metalness = quad.number("metalness", 0.0f, 1.0f, 1.0f);
    material.base_color = quad.has("base_color") ? read_color(quad, "base_color", 1.0f) : glm::vec3(0.95f);
    material.emission = quad.has("emission") ? read_color(quad, "emission", any_radiance) : glm::vec3(0.0f);
    material.is_double_sided = quad.boolean("double_sided", true);
    if (quad.boolean("masked", false)) {
        material.alpha_mode = AlphaMode::mask;
        material.base_color_texture.texture = add_mask(scene);
    }
    quad.finish();
    Mesh mesh{.name = "quad", .indices = {0, 1, 2}, .material = unsigned(scene.materials.size())};
    if (corners.size() == 4) mesh.indices.insert(mesh.indices.end(), {0, 2, 3});
    constexpr glm::vec2 uv[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (size_t i = 0; i < corners.size(); ++i)
        mesh.vertices.push_back({.position = corners[i],
                                 .normal = normal,
                                 .tangent = {1, 0, 0, 1},
                                 .uv = {uv[i], uv[i]},
                                 .color = glm::vec4(1)});
    scene.instances.push_back({.mesh = unsigned(scene.meshes.size()), .node = unsigned(scene.nodes.size())});
    scene.materials.push_back(material), scene.meshes.push_back(mesh), scene.nodes.push_back({.name = "quad"});
}

}  // namespace

Shot changed_shot(const CaseScene& wanted, const std::vector<std::filesystem::path>& search_path) {
    Shot shot = load_shot(wanted.shot, search_path);
    shot.facts = {.camera_moves = true};  // by which nothing is left out
    Scene& scene = shot.scene;
    SceneCamera& camera = shot.camera;
    if (!wanted.quads.is_null()) {
        const nlohmann::json list = {{"quads", wanted.quads}};
        for (JsonObject& quad : JsonObject(list, wanted.where).objects("quads")) add_quad(scene, std::move(quad));
    }
    if (wanted.roughness) {
        const nlohmann::json entry = {{"material", ".*"}, {"roughness", *wanted.roughness}};
        JsonObject object(entry, "a case's 'roughness'");
        ChangedTexels changed;
        apply_override(object, scene, changed);
    }
    if (wanted.radiance != 1.0f) brighten(scene, wanted.radiance);
    if (!wanted.view.is_null()) camera = read_camera(JsonObject(wanted.view, wanted.where + ": view"), scene);
    if (camera.far == 0.0f) camera.far = 1000.0f;
    if (wanted.near) camera.near = *wanted.near;
    if (wanted.far) camera.far = *wanted.far;
    if (wanted.instance_scale != glm::vec3(1.0f)) scale_instances(scene, wanted.instance_scale);
    if (wanted.scale != glm::vec3(1.0f)) {
        scale_nodes(scene, wanted.scale);
        camera.node += camera.node >= 0;
        if (wanted.scales_all) scale_lights(scene, wanted.scale.x), scale_camera(camera, wanted.scale.x);
    }
    scene.content_hash = content_hash(scene);
    return shot;
}
