#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/gltf/gltf_parts.h"
#include "core/scene/gltf/gltf_value.h"

#include <algorithm>

namespace {
const char* const variants_extension = "KHR_materials_variants";

std::vector<std::string> variant_names(const GltfFile& file) {
    std::vector<std::string> names;
    const tinygltf::Value* extension = find_extension(file.model.extensions, variants_extension);
    if (!extension) return names;
    const tinygltf::Value& variants = extension->Get("variants");
    for (int i = 0; i < int(variants.ArrayLen()); ++i) names.push_back(variants.Get(i).Get("name").Get<std::string>());
    return names;
}
}  // namespace

int find_material_variant(const GltfFile& file, const std::string& name) {
    if (name.empty()) return -1;
    const std::vector<std::string> names = variant_names(file);
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return int(found - names.begin());
    if (names.empty())
        fail(file.name(), " has no material variant '", shortened(name),
             "': it has no variants (KHR_materials_variants)");
    const auto quoted = [](const std::string& known) { return "'" + shortened(known) + "'"; };
    fail(file.name(), " has no material variant '", shortened(name), "'", suggestion(name, names), "; it has ",
         joined(names_of(names, quoted)));
}

int material_of(const tinygltf::Primitive& primitive, int variant) {
    const tinygltf::Value* extension = find_extension(primitive.extensions, variants_extension);
    if (variant < 0 || !extension) return primitive.material;
    const tinygltf::Value& mappings = extension->Get("mappings");
    for (int i = 0; i < int(mappings.ArrayLen()); ++i) {
        const tinygltf::Value& mapping = mappings.Get(i);
        const tinygltf::Value& variants = mapping.Get("variants");
        for (int k = 0; k < int(variants.ArrayLen()); ++k)
            if (variants.Get(k).GetNumberAsInt() == variant) return index_member(mapping, "material");
    }
    return primitive.material;
}
