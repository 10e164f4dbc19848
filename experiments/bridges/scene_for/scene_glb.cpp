#include "experiments/bridges/scene_for/scene_glb.h"

#include "core/scene/deform.h"
#include "core/scene/gltf/tangents.h"
#include "core/scene/texture_slots.h"
#include "experiments/bridges/scene_for/glb_file.h"
#include "experiments/bridges/scene_for/scene_numbers.h"
#include "experiments/bridges/scene_for/texture_png.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace {

using nlohmann::json;

int wrap_mode(TextureWrap wrap) {  // glTF 2.0, section 5.26
    return wrap == TextureWrap::repeat ? 10497 : wrap == TextureWrap::mirrored_repeat ? 33648 : 33071;
}

class Writer {
public:
    Writer(const Scene& scene, const ScenePose& pose) : scene_(scene), pose_(pose) {
        glb_.json["scene"] = 0;
        glb_.json["scenes"] = {{{"nodes", json::array()}}};
    }

    void write(const std::filesystem::path& file, const std::vector<GlbCamera>& cameras) {
        for (const Material& material : scene_.materials) glb_.add("materials", material_of(material));
        add_instances();
        for (const PunctualLight& light : pose_.lights) add_light(light);
        for (const GlbCamera& camera : cameras) add_camera(camera);
        glb_.write(file);
    }

private:
    void add_node(json node) {
        const size_t index = glb_.add("nodes", std::move(node));
        glb_.json["scenes"][0]["nodes"].push_back(index);
    }

    /// Textures that show the same texels share an image; each has its own sampler.
    size_t texture(size_t index) {
        if (const auto found = textures_.find(index); found != textures_.end()) return found->second;
        const Texture& texture = scene_.textures[index];
        auto image = images_.find(texture.rgba.get());
        if (image == images_.end()) {
            const size_t view = glb_.add_bytes(texture_png(texture));
            image =
                images_
                    .emplace(texture.rgba.get(), glb_.add("images", {{"bufferView", view}, {"mimeType", "image/png"}}))
                    .first;
        }
        constexpr int nearest = 9728, linear = 9729;  // level 0 alone, as ssrlab filters
        const int filter = texture.is_nearest ? nearest : linear;
        const size_t sampler = glb_.add("samplers", {{"magFilter", filter},
                                                     {"minFilter", filter},
                                                     {"wrapS", wrap_mode(texture.wrap_u)},
                                                     {"wrapT", wrap_mode(texture.wrap_v)}});
        return textures_[index] = glb_.add("textures", {{"source", image->second}, {"sampler", sampler}});
    }

    json slot_of(const TextureSlot& slot) {
        json info = {{"index", texture(size_t(slot.texture))}};
        if (slot.texcoord > 0) info["texCoord"] = slot.texcoord;
        const glm::mat3& m = slot.uv_transform;
        if (m == glm::mat3(1.0f)) return info;
        // KHR_texture_transform: columns (c sx, -s sx) and (s sy, c sy), of which sx is taken as positive.
        const float width = std::hypot(m[0][0], m[0][1]), height = std::hypot(m[1][0], m[1][1]);
        const bool is_mirrored = m[0][0] * m[1][1] - m[0][1] * m[1][0] < 0;
        info["extensions"]["KHR_texture_transform"] = {
            {"offset", {m[2][0], m[2][1]}},
            {"rotation", width > 0 ? std::atan2(-m[0][1], m[0][0]) : std::atan2(m[1][0], m[1][1])},
            {"scale", {width, is_mirrored ? -height : height}}};
        glb_.uses_extension("KHR_texture_transform");
        return info;
    }

    json material_of(const Material& material) {
        json pbr = {{"baseColorFactor", numbers_of(glm::vec4(material.base_color, material.alpha))},
                    {"metallicFactor", number_of(material.metalness)},
                    {"roughnessFactor", number_of(material.roughness)}};
        const auto add_slot = [&](json& to, const char* key, const TextureSlot& slot) {
            if (slot.texture >= 0) to[key] = slot_of(slot);
        };
        add_slot(pbr, "baseColorTexture", material.base_color_texture);
        add_slot(pbr, "metallicRoughnessTexture", material.metalness_roughness_texture);
        json all = {{"name", material.name}, {"pbrMetallicRoughness", std::move(pbr)}};
        add_slot(all, "normalTexture", material.normal_texture);
        if (all.contains("normalTexture")) all["normalTexture"]["scale"] = number_of(material.normal_scale);
        add_slot(all, "occlusionTexture", material.occlusion_texture);
        add_slot(all, "emissiveTexture", material.emission_texture);
        // The factor itself is at most 1; what is brighter stands in the extension.
        const float strength = std::max({material.emission.x, material.emission.y, material.emission.z, 1.0f});
        all["emissiveFactor"] = numbers_of(glm::min(material.emission / strength, 1.0f));
        if (strength > 1.0f)
            add_extension(all, "KHR_materials_emissive_strength", {{"emissiveStrength", number_of(strength)}});
        if (json specular = specular_of(material); !specular.empty())
            add_extension(all, "KHR_materials_specular", std::move(specular));
        if (material.dielectric_f0 != 0.04f)
            add_extension(all, "KHR_materials_ior", {{"ior", index_of_refraction(material.dielectric_f0)}});
        if (material.is_unlit) add_extension(all, "KHR_materials_unlit", json::object());
        if (material.alpha_mode == AlphaMode::mask)
            all["alphaMode"] = "MASK", all["alphaCutoff"] = number_of(material.alpha_cutoff);
        // Where ssrlab draws both sides an engine that leaves out backs would show another scene.
        all["doubleSided"] = !scene_.hides_backs_of(material);
        return all;
    }

    /// KHR_materials_specular, as far as it is not its default.
    json specular_of(const Material& material) {
        json specular = json::object();
        if (material.specular != 1.0f) specular["specularFactor"] = number_of(material.specular);
        if (material.specular_texture.texture >= 0) specular["specularTexture"] = slot_of(material.specular_texture);
        if (material.specular_color != glm::vec3(1.0f))
            specular["specularColorFactor"] = numbers_of(material.specular_color);
        if (material.specular_color_texture.texture >= 0)
            specular["specularColorTexture"] = slot_of(material.specular_color_texture);
        return specular;
    }

    /// Of the reflectance at normal incidence, seen from air; 0 stands for an infinite one (KHR_materials_ior).
    static double index_of_refraction(float f0) {
        const double amplitude = std::sqrt(double(f0));
        return f0 >= 1.0f ? 0.0 : (1.0 + amplitude) / (1.0 - amplitude);
    }

    void add_extension(json& to, const char* name, json value) {
        to["extensions"][name] = std::move(value);
        glb_.uses_extension(name);
    }

    template <class Of>
    size_t attribute(const Mesh& mesh, unsigned components, const Of& of, bool has_bounds = false) {
        std::vector<float> values;
        values.reserve(mesh.vertices.size() * components);
        for (const Vertex& vertex : mesh.vertices) {
            const auto value = of(vertex);
            for (unsigned c = 0; c < components; ++c) values.push_back(value[int(c)]);
        }
        return glb_.add_floats(values, components, has_bounds);
    }

    size_t mesh(size_t index) {
        if (const auto found = meshes_.find(index); found != meshes_.end()) return found->second;
        const Mesh& mesh = scene_.meshes[index];
        json attributes = {{"POSITION", attribute(
                                            mesh, 3, [](const Vertex& v) { return v.position; }, true)},
                           {"NORMAL", attribute(mesh, 3, [](const Vertex& v) { return v.normal; })}};
        // A glTF's tangents are those of its coordinates; where the texture is turned, who reads it derives them.
        const Material& material = scene_.materials[mesh.material];
        const TextureSlot& normals = material.normal_texture;
        if (normals.texture >= 0 && !turns_tangents(normals.uv_transform))
            attributes["TANGENT"] = attribute(mesh, 4, [](const Vertex& v) { return v.tangent; });
        const auto is_read = [&](unsigned set) {  // glTF 2.0, section 3.9.2: what a texture names has to be there
            return std::ranges::any_of(texture_slots(material), [&](const TextureSlot* slot) {
                return slot->texture >= 0 && slot->texcoord == set;
            });
        };
        for (unsigned set = 0; set < 2; ++set)
            if (is_read(set) ||
                std::ranges::any_of(mesh.vertices, [&](const Vertex& v) { return v.uv[set] != glm::vec2(0.0f); }))
                attributes["TEXCOORD_" + std::to_string(set)] =
                    attribute(mesh, 2, [&](const Vertex& v) { return v.uv[set]; });
        if (std::ranges::any_of(mesh.vertices, [](const Vertex& v) { return v.color != glm::vec4(1.0f); }))
            attributes["COLOR_0"] = attribute(mesh, 4, [](const Vertex& v) { return v.color; });
        json primitive = {{"attributes", std::move(attributes)},
                          {"indices", glb_.add_indices(mesh.indices)},
                          {"material", mesh.material}};
        return meshes_[index] = glb_.add("meshes", {{"name", mesh.name}, {"primitives", {std::move(primitive)}}});
    }

    void add_instances() {
        const std::vector<std::string> names = instance_names(scene_);
        for (size_t i = 0; i < scene_.instances.size(); ++i)
            add_node({{"name", names[i]},
                      {"mesh", mesh(scene_.instances[i].mesh)},
                      {"matrix", matrix_numbers(pose_.world_from_instance[i])}});
    }

    void add_light(const PunctualLight& light) {
        constexpr const char* types[] = {"directional", "point", "spot"};
        const float strength = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
        json entry = {{"type", types[size_t(light.type)]},
                      {"name", light.name},
                      {"color", numbers_of(strength > 0 ? light.intensity / strength : glm::vec3(1.0f))},
                      {"intensity", number_of(strength)}};
        if (light.range > 0) entry["range"] = number_of(light.range);
        if (light.type == LightType::spot)
            entry["spot"] = {{"innerConeAngle", std::acos(std::clamp(light.inner_cone_cos, -1.0f, 1.0f))},
                             {"outerConeAngle", std::acos(std::clamp(light.outer_cone_cos, -1.0f, 1.0f))}};
        json& lights = glb_.json["extensions"]["KHR_lights_punctual"]["lights"];
        lights.push_back(std::move(entry));
        glb_.uses_extension("KHR_lights_punctual");
        const glm::vec3 back = -light.direction;  // light travels along -z of its node
        const glm::vec3 right =
            glm::normalize(glm::cross(std::abs(back.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0), back));
        const glm::mat4 world_from_light(glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f),
                                         glm::vec4(back, 0.0f), glm::vec4(light.position, 1.0f));
        add_node({{"name", "light_" + std::to_string(lights.size() - 1)},
                  {"matrix", matrix_numbers(world_from_light)},
                  {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}});
    }

    void add_camera(const GlbCamera& camera) {
        const SceneCamera& lens = camera.lens;
        json entry = {{"name", lens.name}};
        if (lens.is_orthographic) {
            const float half = 0.5f * lens.orthographic_height;
            entry["type"] = "orthographic";
            entry["orthographic"] = {{"xmag", half * camera.aspect},
                                     {"ymag", half},
                                     {"znear", number_of(lens.near)},
                                     {"zfar", number_of(lens.far)}};
        } else {
            entry["type"] = "perspective";
            entry["perspective"] = {{"yfov", number_of(lens.vertical_fov)},
                                    {"aspectRatio", camera.aspect},
                                    {"znear", number_of(lens.near)},
                                    {"zfar", number_of(lens.far)}};
        }
        const size_t index = glb_.add("cameras", std::move(entry));
        add_node({{"name", "camera_" + std::to_string(index)},
                  {"camera", index},
                  {"matrix", matrix_numbers(camera.world_from_camera)}});
    }

    const Scene& scene_;
    const ScenePose& pose_;
    GlbFile glb_;
    std::map<size_t, size_t> textures_, meshes_;            ///< from the scene's index to the file's
    std::map<const std::vector<uint8_t>*, size_t> images_;  ///< of texels
};

}  // namespace

std::vector<std::string> instance_names(const Scene& scene) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const Instance& instance : scene.instances) {
        std::string name = scene.nodes[instance.node].name;
        for (char& c : name)
            if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
        if (name.empty()) name = "node_" + std::to_string(instance.node);
        std::string unique = name;
        for (unsigned n = 2; !taken.insert(unique).second; ++n) unique = name + "_" + std::to_string(n);
        names.push_back(std::move(unique));
    }
    return names;
}

void write_scene_glb(const std::filesystem::path& file, const Scene& scene, const ScenePose& pose,
                     const std::vector<GlbCamera>& cameras) {
    Scene storage;
    Writer(with_posed_meshes(scene, pose, storage), pose).write(file, cameras);
}
