#include "core/scene/gltf/gltf_deformers.h"
#include "core/scene/gltf/gltf_parts.h"
#include "core/scene/gltf/tangents.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/ranges.h"
#include "core/scene/texture_slots.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

namespace {
const tinygltf::Primitive& primitive_of(const GltfFile& file, size_t mesh, size_t primitive) {
    return file.model.meshes[mesh].primitives[primitive];
}

/// Index lists of strips and fans as triangles (glTF 2.0, section 3.7.2.1: the first vertex of odd strip triangles
/// stays, the other two swap, so that all face the same way).
std::vector<uint32_t> triangle_list(const std::vector<uint32_t>& indices, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES) return indices;
    std::vector<uint32_t> triangles;
    for (size_t i = 0; i + 2 < indices.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
            const size_t odd = i % 2;
            triangles.insert(triangles.end(), {indices[i], indices[i + 1 + odd], indices[i + 2 - odd]});
        } else {
            triangles.insert(triangles.end(), {indices[i + 1], indices[i + 2], indices[0]});
        }
    }
    return triangles;
}

std::vector<uint32_t> read_triangles(const GltfFile& file, const tinygltf::Primitive& primitive, size_t vertex_count,
                                     const std::string& what) {
    std::vector<uint32_t> indices;
    if (primitive.indices >= 0) {
        indices = read_indices(file, primitive.indices, what + " indices");
    } else {
        indices.resize(vertex_count);
        for (size_t i = 0; i < vertex_count; ++i) indices[i] = uint32_t(i);
    }
    for (const uint32_t index : indices)
        if (index >= vertex_count)
            fail(file.name(), ": ", what, " has the index ", index, ", but only ", vertex_count, " vertices");
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode == TINYGLTF_MODE_TRIANGLES && indices.size() % 3 != 0)
        fail(file.name(), ": ", what, " has ", indices.size(), " indices, no multiple of 3");
    return triangle_list(indices, mode);
}

/// Calls set(vertex, values) for each vertex with the attribute's values. Returns false if the primitive has none of
/// that name.
template <class Set>
bool read_attribute(const GltfFile& file, const tinygltf::Primitive& primitive, const char* name, unsigned components,
                    std::vector<Vertex>& vertices, const std::string& what, const Set& set) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return false;
    const std::string attribute = what + " " + name;
    const std::vector<float> values = read_floats(file, found->second, components, attribute);
    if (values.size() != vertices.size() * components)
        fail(file.name(), ": ", attribute, " has ", values.size() / components, " elements for ", vertices.size(),
             " vertices");
    for (size_t i = 0; i < vertices.size(); ++i) set(vertices[i], &values[i * components]);
    return true;
}

unsigned color_components(const GltfFile& file, const tinygltf::Primitive& primitive) {
    const auto found = primitive.attributes.find("COLOR_0");
    if (found == primitive.attributes.end()) return 4;
    const size_t index = checked_index(file, found->second, file.model.accessors.size(), "COLOR_0: accessor");
    return file.model.accessors[index].type == TINYGLTF_TYPE_VEC3 ? 3 : 4;
}

/// Vertices and indices of a mesh, its flat normals and the transient lists of what makes tangents included.
void set_aside(const GltfFile& file, const tinygltf::Primitive& primitive, size_t vertex_count, const std::string& what,
               MemoryShare& memory) {
    const bool has_indices = primitive.indices >= 0 && size_t(primitive.indices) < file.model.accessors.size();
    size_t index_count = has_indices ? file.model.accessors[size_t(primitive.indices)].count : vertex_count;
    if (primitive.mode > TINYGLTF_MODE_TRIANGLES) index_count *= 3;
    const size_t most_vertices = std::max(vertex_count, index_count);  // where normals or tangents part them
    memory.add(double(most_vertices) * (sizeof(Vertex) + deformation_bytes(primitive)) +
                   double(index_count) * sizeof(uint32_t),
               file.name() + ": " + what + " of " + std::to_string(vertex_count) + " vertices and " +
                   std::to_string(index_count) + " indices");
}

std::string uv_name(unsigned set) { return "TEXCOORD_" + std::to_string(set); }

/// The default material has no textures.
std::array<unsigned, 2> uv_sets_of(const GltfFile& file, unsigned material) {
    return material < file.uv_sets.size() ? file.uv_sets[material] : std::array<unsigned, 2>{0, 1};
}

/// glTF 2.0, section 3.9.2: a primitive must have the texture coordinates that its material's textures name.
void warn_of_missing_uvs(GltfFile& file, const tinygltf::Primitive& primitive, size_t mesh_index,
                         unsigned material_index, const Scene& scene) {
    const Material& material = scene.materials[material_index];
    const std::string& name = file.model.meshes[mesh_index].name;
    const auto slots = texture_slots(material);
    for (size_t i = 0; i < slots.size(); ++i) {
        if (slots[i]->texture < 0) continue;
        const std::string attribute = uv_name(uv_sets_of(file, material_index)[slots[i]->texcoord]);
        if (!primitive.attributes.contains(attribute))
            file.warn("Mesh " + (name.empty() ? std::to_string(mesh_index) : "'" + shortened(name) + "'") + " has no " +
                          attribute + ", which the " + texture_channels[i] + " texture of material '" +
                          shortened(material.name) + "' uses: one texel is seen everywhere.",
                      int(material_index));
    }
}

Mesh read_mesh(const GltfFile& file, Scene& scene, size_t mesh_index, size_t primitive_index, int variant,
               std::string& warning) {
    const tinygltf::Primitive& primitive = primitive_of(file, mesh_index, primitive_index);
    const std::string what = "mesh " + std::to_string(mesh_index) + " primitive " + std::to_string(primitive_index);
    Mesh mesh;
    mesh.name = file.model.meshes[mesh_index].name;
    const int material = material_of(primitive, variant);
    mesh.material = material < 0
                        ? unsigned(scene.materials.size() - 1)
                        : unsigned(checked_index(file, material, file.model.materials.size(), what + ": material"));
    const auto position = primitive.attributes.find("POSITION");
    const size_t accessor =
        checked_index(file, position->second, file.model.accessors.size(), what + " POSITION: accessor");
    const std::vector<float> positions = read_floats(file, int(accessor), 3, what + " POSITION");
    const auto far_off = std::ranges::find_if(positions, [](float x) { return !(std::abs(x) <= any_length); });
    if (far_off != positions.end())
        fail(file.name(), ": ", what, " POSITION: element ", (far_off - positions.begin()) / 3, " has the coordinate ",
             *far_off, " outside of [", -any_length, ", ", any_length, "] m");
    set_aside(file, primitive, positions.size() / 3, what, scene.memory);
    mesh.vertices.resize(positions.size() / 3, Vertex{.color = glm::vec4(1.0f)});
    for (size_t i = 0; i < mesh.vertices.size(); ++i) mesh.vertices[i].position = glm::make_vec3(&positions[i * 3]);

    const auto attribute = [&](const char* name, unsigned components, const auto& set) {
        return read_attribute(file, primitive, name, components, mesh.vertices, what, set);
    };
    const bool has_normals = attribute("NORMAL", 3, [](Vertex& v, const float* x) { v.normal = {x[0], x[1], x[2]}; });
    const bool has_tangents = attribute("TANGENT", 4, [](Vertex& v, const float* x) {
        v.tangent = {x[0], x[1], x[2], x[3]};
    });
    const auto sets = uv_sets_of(file, mesh.material);
    for (size_t k = 0; k < 2; ++k)
        attribute(uv_name(sets[k]).c_str(), 2, [&](Vertex& v, const float* x) { v.uv[k] = {x[0], x[1]}; });
    const unsigned components = color_components(file, primitive);
    attribute("COLOR_0", components, [&](Vertex& v, const float* x) {
        // glTF 2.0, section 3.7.2.1: within [0, 1].
        v.color = glm::clamp(glm::vec4(x[0], x[1], x[2], components == 4 ? x[3] : 1.0f), 0.0f, 1.0f);
    });
    mesh.indices = read_triangles(file, primitive, mesh.vertices.size(), what);
    mesh.is_flat_shaded = !has_normals;
    const TextureSlot& normal_texture = scene.materials[mesh.material].normal_texture;
    if (!deforms_vertices(primitive)) {
        finish_normals(mesh, has_tangents, normal_texture);
        return mesh;
    }
    const Mesh as_in_file = mesh;
    finish_normals(mesh, has_tangents, normal_texture);
    add_deformers({file, primitive, as_in_file, has_tangents, what}, normal_texture, mesh, warning);
    return mesh;
}

/// Whether a primitive becomes a mesh; says why where it does not.
bool is_drawn(GltfFile& file, size_t mesh_index, size_t primitive_index) {
    const tinygltf::Primitive& primitive = primitive_of(file, mesh_index, primitive_index);
    const std::string name = file.model.meshes[mesh_index].name;
    for (const auto& [attribute, accessor] : primitive.attributes) {
        static const std::set<std::string> known = {"POSITION", "NORMAL", "TANGENT", "COLOR_0"};
        // Further sets are read where a texture uses them; "_" begins what is of an application alone.
        const bool is_of_no_effect =
            attribute.starts_with("TEXCOORD_") || attribute.starts_with("COLOR_") || attribute.starts_with("_");
        if (!known.contains(attribute) && !is_of_no_effect && !is_of_joints(primitive, attribute))
            file.warn("The vertex attribute " + attribute + " of mesh '" + name + "' is ignored.");
    }
    if (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        file.warn("Points or lines of mesh '" + name + "' are not drawn.");
        return false;
    }
    if (!primitive.attributes.contains("POSITION")) {
        file.warn("A primitive of mesh '" + name + "' is not drawn, since it has no positions.");
        return false;
    }
    return true;
}
}  // namespace

std::vector<std::vector<unsigned>> add_meshes(GltfFile& file, Scene& scene, const GltfChoices& choices) {
    const int variant = find_material_variant(file, choices.material_variant);
    std::vector<std::vector<unsigned>> meshes_of(file.model.meshes.size());
    std::vector<std::pair<size_t, size_t>> drawn;
    for (size_t mesh = 0; mesh < meshes_of.size(); ++mesh)
        for (size_t primitive = 0; primitive < file.model.meshes[mesh].primitives.size(); ++primitive) {
            if (!is_drawn(file, mesh, primitive)) continue;
            meshes_of[mesh].push_back(unsigned(scene.meshes.size() + drawn.size()));
            drawn.emplace_back(mesh, primitive);
        }
    const size_t first = scene.meshes.size();
    scene.meshes.resize(first + drawn.size());
    std::vector<std::string> warnings(drawn.size());
    tbb::parallel_for(size_t(0), drawn.size(), [&](size_t i) {
        scene.meshes[first + i] = read_mesh(file, scene, drawn[i].first, drawn[i].second, variant, warnings[i]);
    });
    for (size_t i = 0; i < drawn.size(); ++i) {
        warn_of_targets(file, drawn[i].first, drawn[i].second);
        if (!warnings[i].empty()) file.warn(warnings[i], int(scene.meshes[first + i].material));
        warn_of_missing_uvs(file, primitive_of(file, drawn[i].first, drawn[i].second), drawn[i].first,
                            scene.meshes[first + i].material, scene);
    }
    return meshes_of;
}
