#include "core/scene/gltf/gltf_deformers.h"
#include "core/scene/gltf/gltf_drawn.h"
#include "core/scene/gltf/gltf_parts.h"
#include "core/scene/gltf/gltf_value.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/ranges.h"
#include "core/scene/transform.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <numbers>

namespace {
Node read_node(const GltfFile& file, const tinygltf::Node& source, size_t index) {
    const std::string what = "node " + std::to_string(index) + " ('" + shortened(source.name) + "')";
    Node node;
    node.name = source.name;
    node.translation = fixed_vector<3>(file, source.translation, glm::vec3(0.0f), what + ": translation");
    const glm::vec4 rotation =
        fixed_vector<4>(file, source.rotation, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f), what + ": rotation");
    const glm::dvec4 unscaled(rotation);  // whose square is finite, and not 0 unless it is
    if (!(glm::dot(unscaled, unscaled) > 0.0)) fail(file.name(), ": ", what, ": rotation is the zero quaternion");
    node.rotation = glm::vec4(glm::normalize(unscaled));
    node.scale = fixed_vector<3>(file, source.scale, glm::vec3(1.0f), what + ": scale");
    for (int i = 0; i < 3; ++i) {
        checked_number(file, node.translation[i], -any_length, any_length, what + ": translation");
        checked_number(file, node.scale[i], -any_length, any_length, what + ": scale");
    }
    node.parent_from_node = transform(node.translation, node.rotation, node.scale);
    if (source.matrix.empty()) return node;
    for (int i = 0; i < 16; ++i)
        node.parent_from_node[i / 4][i % 4] =
            checked_number(file, source.matrix[size_t(i)], -any_length, any_length, what + ": matrix");
    split_transform(node.parent_from_node, node.translation, node.rotation, node.scale);
    return node;
}

/// Weights of the morph targets of what a node draws: its own, else its mesh's, else 0 (glTF 2.0, section 3.7.2.2).
std::vector<float> morph_weights(const GltfFile& file, const tinygltf::Node& node, size_t index) {
    if (node.mesh < 0) return {};
    const size_t mesh = checked_index(file, node.mesh, file.model.meshes.size(), "mesh");
    std::vector<float> weights(target_count(file, mesh), 0.0f);
    if (weights.empty()) return {};
    const bool are_own = !node.weights.empty();
    const std::vector<double>& given = are_own ? node.weights : file.model.meshes[mesh].weights;
    const std::string what = are_own ? "node " + std::to_string(index) + " ('" + shortened(node.name) + "'): weights"
                                     : "mesh " + std::to_string(mesh) + ": weights";
    if (!given.empty() && given.size() != weights.size())
        fail(file.name(), ": ", what, " has ", given.size(), " numbers, but the mesh has ", weights.size(),
             " morph targets");
    for (size_t i = 0; i < given.size(); ++i) weights[i] = checked_number(file, given[i], -FLT_MAX, FLT_MAX, what);
    return weights;
}

LightType light_type(const std::string& type) {
    if (type == "directional") return LightType::directional;
    return type == "point" ? LightType::point : LightType::spot;
}

/// Units: ssrlab reads KHR_lights_punctual's lux and candela as W m^-2 and W sr^-1, as it reads all radiance.
PunctualLight read_light(const GltfFile& file, int index, int node) {
    const auto& source = file.model.lights[checked_index(file, index, file.model.lights.size(), "light")];
    const std::string what = "light " + std::to_string(index);
    PunctualLight light;
    light.name = source.name;
    light.type = light_type(source.type);
    const glm::vec3 color = fixed_vector<3>(file, source.color, glm::vec3(1.0f), what + ": color");
    light.intensity = color * checked_number(file, source.intensity, 0.0, any_radiance, what + ": intensity");
    for (int i = 0; i < 3; ++i)
        checked_number(file, light.intensity[i], 0.0, any_radiance, what + ": the product of color and intensity");
    light.range = checked_number(file, source.range, 0.0, FLT_MAX, what + ": range");
    light.node = node;
    if (light.type != LightType::spot) return light;
    const double outer =
        checked_number(file, source.spot.outerConeAngle, 0.0, std::numbers::pi / 2, what + ": outerConeAngle");
    const double inner = checked_number(file, source.spot.innerConeAngle, 0.0, outer, what + ": innerConeAngle");
    light.inner_cone_cos = float(std::cos(inner));
    light.outer_cone_cos = float(std::cos(outer));
    return light;
}

/// far = 0 where the file names none; load_scene() derives it.
SceneCamera read_camera(const GltfFile& file, int index, int node) {
    const auto& source = file.model.cameras[checked_index(file, index, file.model.cameras.size(), "camera")];
    const std::string what = "camera " + std::to_string(index);
    SceneCamera camera;
    camera.name = source.name.empty() ? "camera_" + std::to_string(index) : source.name;
    camera.node = node;
    camera.is_orthographic = source.type == "orthographic";
    if (camera.is_orthographic) {
        const auto& lens = source.orthographic;
        camera.orthographic_height =
            2.0f * checked_number(file, std::abs(lens.ymag), FLT_MIN, any_length, what + ": ymag");
        camera.aspect = 2.0f * checked_number(file, std::abs(lens.xmag), FLT_MIN, any_length, what + ": xmag") /
                        camera.orthographic_height;
        camera.near = checked_number(file, lens.znear, 0.0, any_length, what + ": znear");
        camera.far = checked_number(file, lens.zfar, 0.0, any_far_plane, what + ": zfar");
    } else {
        const auto& lens = source.perspective;
        camera.vertical_fov = checked_number(file, lens.yfov, 1e-6, std::numbers::pi - 1e-3, what + ": yfov");
        camera.aspect = checked_number(file, lens.aspectRatio, 0.0, any_length, what + ": aspectRatio");
        camera.near = checked_number(file, lens.znear, FLT_MIN, any_length, what + ": znear");
        camera.far = checked_number(file, lens.zfar, 0.0, any_far_plane, what + ": zfar");
    }
    if (camera.far != 0.0f && camera.far <= camera.near)
        fail(file.name(), ": ", what, ": zfar ", camera.far, " is not beyond znear ", camera.near);
    return camera;
}

void warn_of_other_scenes(GltfFile& file) {
    const auto& scenes = file.model.scenes;
    if (scenes.size() < 2) return;
    const auto shown = size_t(std::max(file.model.defaultScene, 0));
    const std::string name = scenes[shown].name.empty() ? "scenes[" + std::to_string(shown) + "]"
                                                        : "'" + shortened(scenes[shown].name) + "'";
    file.warn("Of the " + std::to_string(scenes.size()) + " scenes of the file, " + name + " is shown.");
}

/// KHR_node_visibility of the node itself.
bool is_hidden(const tinygltf::Node& source) {
    const tinygltf::Value* extension = find_extension(source.extensions, "KHR_node_visibility");
    return extension && extension->Has("visible") && !extension->Get("visible").Get<bool>();
}

void add_meshes_of(const GltfFile& file, const tinygltf::Node& source,
                   const std::vector<std::vector<unsigned>>& meshes_of, unsigned node, Scene& scene) {
    const auto& meshes = meshes_of[checked_index(file, source.mesh, meshes_of.size(), "mesh")];
    if (add_mesh_copies(file, source, meshes, node, "node '" + shortened(source.name) + "'", scene)) return;
    for (const unsigned mesh : meshes) scene.instances.push_back({mesh, node, source.skin});
}

void add_contents(GltfFile& file, const tinygltf::Node& source, const std::vector<std::vector<unsigned>>& meshes_of,
                  unsigned node, bool is_visible, Scene& scene) {
    if (source.camera >= 0) scene.cameras.push_back(read_camera(file, source.camera, int(node)));
    if (!is_visible) return;
    if (source.mesh >= 0) add_meshes_of(file, source, meshes_of, node, scene);
    if (const auto light = source.extensions.find("KHR_lights_punctual"); light != source.extensions.end())
        scene.lights.push_back(read_light(file, index_member(light->second, "light"), int(node)));
}
}  // namespace

std::vector<int> add_nodes(GltfFile& file, const std::vector<std::vector<unsigned>>& meshes_of, Scene& scene) {
    const auto& nodes = file.model.nodes;
    std::vector<int> node_of(nodes.size(), -1);
    struct Visit {
        int node, parent;
        bool is_visible;
    };
    std::vector<Visit> open;
    std::vector<glm::mat4> world_from_node;  // at rest
    const auto place = [&](size_t index) {   // of the next of scene.nodes
        const Node& node = scene.nodes[world_from_node.size()];
        world_from_node.push_back((node.parent < 0 ? glm::mat4(1.0f) : world_from_node[size_t(node.parent)]) *
                                  node.parent_from_node);
        if (!is_in_range(world_from_node.back()))
            fail(file.name(), ": node ", index, " ('", shortened(nodes[index].name),
                 "'): its transform times those of its parents has a number outside of [", -any_length, ", ",
                 any_length, "]");
    };
    for (const int root : scene_roots(file)) open.push_back({root, -1, true});
    warn_of_other_scenes(file);
    for (size_t next = 0; next < open.size(); ++next) {  // breadth first: parents come before their children
        const size_t index = checked_index(file, open[next].node, nodes.size(), "node");
        if (node_of[index] >= 0)
            fail(file.name(), ": node ", index, " ('", nodes[index].name, "') has two parents, or is its own ancestor");
        node_of[index] = int(scene.nodes.size());
        scene.nodes.push_back(read_node(file, nodes[index], index));
        scene.nodes.back().parent = open[next].parent;
        scene.nodes.back().weights = morph_weights(file, nodes[index], index);
        place(index);
        const bool is_visible = open[next].is_visible && !is_hidden(nodes[index]);
        add_contents(file, nodes[index], meshes_of, unsigned(node_of[index]), is_visible, scene);
        while (world_from_node.size() < scene.nodes.size()) place(index);  // copies of its mesh
        for (const int child : nodes[index].children) open.push_back({child, node_of[index], is_visible});
    }
    return node_of;
}
