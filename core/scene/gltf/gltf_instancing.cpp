#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/gltf/gltf_parts.h"
#include "core/scene/gltf/gltf_value.h"
#include "core/scene/ranges.h"
#include "core/scene/transform.h"

#include <glm/gtc/type_ptr.hpp>
#include <optional>

namespace {
/// One attribute of EXT_mesh_gpu_instancing, `components` numbers for each copy; empty if absent.
std::vector<float> read_copies(const GltfFile& file, const tinygltf::Value& attributes, const char* name,
                               unsigned components, const std::string& what, std::optional<size_t>& count) {
    const int accessor = index_member(attributes, name);
    if (accessor < 0) return {};
    std::vector<float> values = read_floats(file, accessor, components, what + ": " + name);
    const size_t found = values.size() / components;
    if (count && *count != found)
        fail(file.name(), ": ", what, ": ", name, " has ", found, " elements, but other attributes have ", *count);
    count = found;
    return values;
}
}  // namespace

bool add_mesh_copies(const GltfFile& file, const tinygltf::Node& source, const std::vector<unsigned>& meshes,
                     unsigned node, const std::string& node_name, Scene& scene) {
    const tinygltf::Value* extension = find_extension(source.extensions, "EXT_mesh_gpu_instancing");
    if (!extension) return false;
    const std::string what = node_name + ": EXT_mesh_gpu_instancing";
    const tinygltf::Value& attributes = extension->Get("attributes");
    std::optional<size_t> count;
    const auto translations = read_copies(file, attributes, "TRANSLATION", 3, what, count);
    const auto rotations = read_copies(file, attributes, "ROTATION", 4, what, count);
    const auto scales = read_copies(file, attributes, "SCALE", 3, what, count);
    if (!count) fail(file.name(), ": ", what, " does not place its copies; give TRANSLATION, ROTATION or SCALE");
    scene.memory.add(double(*count) * (sizeof(Node) + double(meshes.size()) * sizeof(Instance)),
                     file.name() + ": " + what + " of " + std::to_string(*count) + " copies");
    for (size_t i = 0; i < *count; ++i) {
        Node copy{.name = source.name, .parent = int(node)};
        const std::string where = what + ": copy " + std::to_string(i);
        if (!translations.empty()) copy.translation = glm::make_vec3(&translations[3 * i]);
        if (!scales.empty()) copy.scale = glm::make_vec3(&scales[3 * i]);
        for (int c = 0; c < 3; ++c) {
            checked_number(file, copy.translation[c], -any_length, any_length, where + ": TRANSLATION");
            checked_number(file, copy.scale[c], -any_length, any_length, where + ": SCALE");
        }
        if (!rotations.empty()) {
            const glm::dvec4 rotation(glm::make_vec4(&rotations[4 * i]));
            if (!(glm::dot(rotation, rotation) > 0.0))
                fail(file.name(), ": ", where, ": ROTATION is the zero quaternion");
            copy.rotation = glm::vec4(glm::normalize(rotation));
        }
        copy.parent_from_node = transform(copy.translation, copy.rotation, copy.scale);
        for (const unsigned mesh : meshes)
            scene.instances.push_back({mesh, unsigned(scene.nodes.size()), source.skin, int(node)});
        scene.nodes.push_back(std::move(copy));
    }
    return true;
}
