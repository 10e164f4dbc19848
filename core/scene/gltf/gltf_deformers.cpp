#include "core/scene/gltf/gltf_deformers.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/deform.h"
#include "core/scene/gltf/tangents.h"
#include "core/scene/ranges.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <map>

namespace {

/// Integers that stand for weights leave sums this far from 1, and so does a sum of eight rounded bytes.
constexpr double any_weight_error = 0.02;

unsigned joint_sets(const tinygltf::Primitive& primitive) {
    unsigned count = 0;
    while (primitive.attributes.contains("JOINTS_" + std::to_string(count)) &&
           primitive.attributes.contains("WEIGHTS_" + std::to_string(count)))
        ++count;
    return count;
}

/// For each vertex of `mesh`, that of the file which it is made of.
std::vector<uint32_t> file_vertices(const Mesh& mesh, const Mesh& as_in_file) {
    std::vector<uint32_t> vertices(mesh.vertices.size(), 0);  // 0 stays for those that no triangle uses
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner)
        vertices[mesh.indices[corner]] = as_in_file.indices[corner];
    return vertices;
}

/// An attribute of a morph target, per vertex of the file; empty if the target has none.
std::vector<glm::vec3> read_deltas(const ReadPrimitive& from, size_t target, const char* name) {
    const auto& attributes = from.primitive.targets[target];
    const auto found = attributes.find(name);
    if (found == attributes.end()) return {};
    const std::string what = from.what + " target " + std::to_string(target) + " " + name;
    const std::vector<float> values = read_floats(from.file, found->second, 3, what);
    if (values.size() != from.as_in_file.vertices.size() * 3)
        fail(from.file.name(), ": ", what, " has ", values.size() / 3, " elements for ",
             from.as_in_file.vertices.size(), " vertices");
    const auto far_off = std::ranges::find_if(values, [](float x) { return !(std::abs(x) <= any_length); });
    if (far_off != values.end())
        fail(from.file.name(), ": ", what, ": element ", (far_off - values.begin()) / 3, " has the part ", *far_off,
             " outside of [", -any_length, ", ", any_length, "]");
    std::vector<glm::vec3> deltas(from.as_in_file.vertices.size());
    for (size_t i = 0; i < deltas.size(); ++i) deltas[i] = glm::make_vec3(&values[3 * i]);
    return deltas;
}

std::vector<glm::vec3> parted(const std::vector<glm::vec3>& deltas, const std::vector<uint32_t>& vertices) {
    std::vector<glm::vec3> result(deltas.empty() ? 0 : vertices.size());
    for (size_t i = 0; i < result.size(); ++i) result[i] = deltas[vertices[i]];
    return result;
}

/// By which tangents that are made from the triangles, or turned with their texture, differ at weight 1 (glTF 2.0,
/// section 3.7.2.2: to be made for each target). `target`: per vertex of the file.
std::vector<glm::vec3> tangent_deltas(const ReadPrimitive& from, const MorphTarget& target,
                                      const TextureSlot& normal_texture, const Mesh& mesh) {
    Mesh moved = from.as_in_file;
    for (size_t i = 0; i < moved.vertices.size(); ++i) {
        if (!target.positions.empty()) moved.vertices[i].position += target.positions[i];
        if (!target.normals.empty()) moved.vertices[i].normal += target.normals[i];
        if (!target.tangents.empty()) moved.vertices[i].tangent += glm::vec4(target.tangents[i], 0.0f);
    }
    finish_normals(moved, from.has_tangents, normal_texture);
    std::vector<glm::vec3> deltas(mesh.vertices.size(), glm::vec3(0.0f));
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const uint32_t vertex = mesh.indices[corner];
        deltas[vertex] =
            glm::vec3(moved.vertices[moved.indices[corner]].tangent) - glm::vec3(mesh.vertices[vertex].tangent);
    }
    return deltas;
}

MorphTarget read_target(const ReadPrimitive& from, size_t index, const TextureSlot& normal_texture, const Mesh& mesh,
                        const std::vector<uint32_t>& vertices) {
    MorphTarget target;
    target.positions = read_deltas(from, index, "POSITION");
    if (!mesh.is_flat_shaded) target.normals = read_deltas(from, index, "NORMAL");
    const bool needs_tangents = normal_texture.texture >= 0, are_given = from.has_tangents && !mesh.is_flat_shaded;
    if (needs_tangents && are_given) target.tangents = read_deltas(from, index, "TANGENT");
    if (needs_tangents && (!are_given || turns_tangents(normal_texture.uv_transform)))
        target.tangents = tangent_deltas(from, target, normal_texture, mesh);
    else
        target.tangents = parted(target.tangents, vertices);
    target.positions = parted(target.positions, vertices);
    target.normals = parted(target.normals, vertices);
    return target;
}

/// What the vertices of the file follow: per vertex those joints whose weight is not 0, which sum to 1.
std::vector<std::vector<JointWeight>> read_joint_weights(const ReadPrimitive& from, std::string& warning) {
    std::vector<std::vector<JointWeight>> followed(from.as_in_file.vertices.size());
    for (unsigned set = 0; set < joint_sets(from.primitive); ++set) {
        const auto what = [&](const std::string& name) { return from.what + " " + name + std::to_string(set); };
        const auto accessor = [&](const std::string& name) {
            return from.primitive.attributes.at(name + std::to_string(set));
        };
        const std::vector<uint32_t> joints = read_indices(from.file, accessor("JOINTS_"), what("JOINTS_"), 4);
        const std::vector<float> weights = read_floats(from.file, accessor("WEIGHTS_"), 4, what("WEIGHTS_"));
        for (const auto& [name, count] : {std::pair("JOINTS_", joints.size()), {"WEIGHTS_", weights.size()}})
            if (count != followed.size() * 4)
                fail(from.file.name(), ": ", what(name), " has ", count / 4, " elements for ", followed.size(),
                     " vertices");
        for (size_t i = 0; i < joints.size(); ++i) {
            if (weights[i] < 0.0f)
                fail(from.file.name(), ": ", what("WEIGHTS_"), ": element ", i / 4, " has the weight ", weights[i],
                     "; weights are at least 0");
            if (weights[i] > 0.0f) followed[i / 4].push_back({joints[i], weights[i]});
        }
    }
    size_t scaled = 0, free = 0;
    for (std::vector<JointWeight>& joints : followed) {
        double sum = 0.0;
        for (const JointWeight& joint : joints) sum += joint.weight;
        scaled += !joints.empty() && std::abs(sum - 1.0) > any_weight_error;
        free += joints.empty();
        if (joints.empty())
            joints.push_back({.joint = 0, .weight = 1.0f});
        else
            for (JointWeight& joint : joints) joint.weight = float(joint.weight / sum);
    }
    const std::string name = " of mesh '" + shortened(from.as_in_file.name) + "'";
    if (scaled > 0)
        warning = "The joint weights of " + std::to_string(scaled) + " vertices" + name +
                  " do not sum to 1 and are scaled so that they do.";
    else if (free > 0)
        warning = std::to_string(free) + " vertices" + name +
                  " follow no joint, as all of their weights are 0; they are drawn with the skin's first joint.";
    return followed;
}

/// The scene's skin of the file's skin `index`.
Skin read_skin(const GltfFile& file, size_t index, const std::vector<int>& node_of) {
    const tinygltf::Skin& source = file.model.skins[index];
    const std::string what = "skin " + std::to_string(index) + " ('" + shortened(source.name) + "')";
    Skin skin;
    for (const int joint : source.joints) {
        const size_t node = checked_index(file, joint, node_of.size(), what + ": joint");
        if (node_of[node] < 0)
            fail(file.name(), ": ", what, " names the joint ", node, " ('", shortened(file.model.nodes[node].name),
                 "'), which is not in the scene that is shown, so that its place is unknown; add its root to the "
                 "scene's nodes");
        skin.joints.push_back(unsigned(node_of[node]));
    }
    if (skin.joints.empty()) fail(file.name(), ": ", what, " has no joints");
    skin.joint_from_mesh.resize(skin.joints.size(), glm::mat4(1.0f));
    if (source.inverseBindMatrices < 0) return skin;
    const std::vector<float> values = read_floats(file, source.inverseBindMatrices, 16, what + " inverseBindMatrices");
    if (values.size() < 16 * skin.joints.size())
        fail(file.name(), ": ", what, " has ", skin.joints.size(), " joints, but only ", values.size() / 16,
             " inverseBindMatrices");
    for (size_t i = 0; i < skin.joints.size(); ++i) skin.joint_from_mesh[i] = glm::make_mat4(&values[16 * i]);
    return skin;
}

/// Fails where a vertex follows a joint that the skin has not.
void check_joints(const GltfFile& file, const Mesh& mesh, const Skin& skin, size_t index) {
    uint32_t last = 0;
    for (const JointWeight& followed : mesh.joint_weights) last = std::max(last, followed.joint);
    if (last >= skin.joints.size())
        fail(file.name(), ": mesh '", shortened(mesh.name), "' follows joint ", last, " of skin ", index, " ('",
             shortened(file.model.skins[index].name), "'), which has ", skin.joints.size());
}

}  // namespace

bool deforms_vertices(const tinygltf::Primitive& primitive) {
    return !primitive.targets.empty() || joint_sets(primitive) > 0;
}

double deformation_bytes(const tinygltf::Primitive& primitive) {
    double bytes = 4.0 * joint_sets(primitive) * sizeof(JointWeight);
    for (const auto& target : primitive.targets)
        for (const char* attribute : {"POSITION", "NORMAL", "TANGENT"})
            if (target.contains(attribute)) bytes += sizeof(glm::vec3);
    // Two more of the vertices as the file has them while it is read, and tangents that are made of each target.
    return deforms_vertices(primitive)
               ? bytes + 2 * sizeof(Vertex) + double(primitive.targets.size()) * sizeof(glm::vec3)
               : 0.0;
}

bool is_of_joints(const tinygltf::Primitive& primitive, const std::string& attribute) {
    for (unsigned set = 0; set < joint_sets(primitive); ++set)
        for (const char* name : {"JOINTS_", "WEIGHTS_"})
            if (attribute == name + std::to_string(set)) return true;
    return false;
}

void add_deformers(const ReadPrimitive& from, const TextureSlot& normal_texture, Mesh& mesh, std::string& warning) {
    const std::vector<uint32_t> vertices = file_vertices(mesh, from.as_in_file);
    for (size_t i = 0; i < from.primitive.targets.size(); ++i)
        mesh.targets.push_back(read_target(from, i, normal_texture, mesh, vertices));
    if (joint_sets(from.primitive) == 0) return;
    const std::vector<std::vector<JointWeight>> followed = read_joint_weights(from, warning);
    for (const auto& joints : followed)
        mesh.joints_per_vertex = std::max(mesh.joints_per_vertex, unsigned(joints.size()));
    mesh.joint_weights.resize(vertices.size() * mesh.joints_per_vertex);
    for (size_t i = 0; i < vertices.size() && !followed.empty(); ++i)
        std::ranges::copy(followed[vertices[i]],
                          mesh.joint_weights.begin() + std::ptrdiff_t(i * mesh.joints_per_vertex));
}

void warn_of_targets(GltfFile& file, size_t mesh, size_t primitive) {
    const tinygltf::Mesh& source = file.model.meshes[mesh];
    for (const auto& target : source.primitives[primitive].targets)
        for (const auto& [attribute, accessor] : target)
            if (attribute.starts_with("TEXCOORD_") || attribute.starts_with("COLOR_"))
                file.warn("The morph targets of mesh '" + shortened(source.name) + "' also move " + attribute +
                          ", which ssrlab does not move.");
}

size_t target_count(const GltfFile& file, size_t mesh) {
    const tinygltf::Mesh& source = file.model.meshes[mesh];
    const size_t count = source.primitives.empty() ? 0 : source.primitives[0].targets.size();
    for (const tinygltf::Primitive& primitive : source.primitives)
        if (primitive.targets.size() != count)
            fail(file.name(), ": mesh ", mesh, " ('", shortened(source.name), "') has primitives with ", count,
                 " and with ", primitive.targets.size(), " morph targets; all must have the same number");
    return count;
}

void add_skins(GltfFile& file, const std::vector<int>& node_of, Scene& scene) {
    std::map<size_t, int> skin_of;  // by the file's index
    std::vector<bool> follows_joints(scene.meshes.size(), false);
    for (Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const std::string& node = scene.nodes[instance.node].name;
        const std::string what = file.name() + ": node '" + shortened(node) + "', which draws " +
                                 std::to_string(mesh.vertices.size()) + " deformed vertices";
        if (instance.skin >= 0) {
            const size_t index =
                checked_index(file, instance.skin, file.model.skins.size(), "node '" + shortened(node) + "': skin");
            if (mesh.joint_weights.empty()) {
                file.warn("The skin of node '" + shortened(node) + "' does not move mesh '" + shortened(mesh.name) +
                              "', which lacks JOINTS_0 or WEIGHTS_0: the mesh stands as its node does.",
                          -1, int(instance.node));
                instance.skin = -1;
                continue;
            }
            const auto [entry, is_new] = skin_of.try_emplace(index, int(scene.skins.size()));
            if (is_new) scene.skins.push_back(read_skin(file, index, node_of));
            instance.skin = entry->second;
            const Skin& skin = scene.skins[size_t(instance.skin)];
            check_joints(file, mesh, skin, index);
            follows_joints[instance.mesh] = true;
            scene.memory.add(2.0 * double(skin.joints.size()) * sizeof(glm::mat4), what);
        }
        // Of this frame and of the one before, and what of both is on its way to the rasteriser.
        if (deforms(scene, instance)) scene.memory.add(4.0 * double(mesh.vertices.size()) * sizeof(Vertex), what);
    }
    for (size_t i = 0; i < scene.meshes.size(); ++i)
        if (!follows_joints[i]) scene.meshes[i].joint_weights = {}, scene.meshes[i].joints_per_vertex = 0;
}
