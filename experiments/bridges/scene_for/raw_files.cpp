#include "experiments/bridges/scene_for/raw_files.h"

#include "core/files.h"
#include "core/path_inside.h"
#include "core/scene/deform.h"
#include "core/scene/texture_slots.h"
#include "experiments/bridges/scene_for/scene_numbers.h"
#include "experiments/bridges/scene_for/texture_png.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

namespace {

using nlohmann::json;

template <class Of>
json values_of(const Mesh& mesh, const Of& of) {
    json values = json::array();
    for (const Vertex& vertex : mesh.vertices) append_numbers(values, of(vertex));
    return values;
}

json mesh_of(const Mesh& mesh) {
    json entry = {{"positions", values_of(mesh, [](const Vertex& v) { return v.position; })},
                  {"normals", values_of(mesh, [](const Vertex& v) { return v.normal; })},
                  {"tangents", values_of(mesh, [](const Vertex& v) { return v.tangent; })},
                  {"uvs", values_of(mesh, [](const Vertex& v) { return v.uv[0]; })},
                  {"indices", mesh.indices}};
    if (std::ranges::any_of(mesh.vertices, [](const Vertex& v) { return v.color != glm::vec4(1.0f); }))
        entry["colors"] = values_of(mesh, [](const Vertex& v) { return v.color; });
    return entry;
}

/// Writes each texture that a material reads.
class TextureFiles {
public:
    TextureFiles(std::filesystem::path folder, const Scene& scene) : folder_(std::move(folder)), scene_(scene) {}

    void enter(json& material, const char* key, const TextureSlot& slot) {
        if (slot.texture < 0) return;
        const std::string name = "textures/" + std::to_string(slot.texture) + ".png";
        if (written_.insert(slot.texture).second) {
            const std::vector<std::byte> bytes = texture_png(scene_.textures[size_t(slot.texture)]);
            write_text(path_inside(folder_, name), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        }
        json transform = json::array();
        for (int column = 0; column < 3; ++column) append_numbers(transform, slot.uv_transform[column]);
        material[key] = {{"file", name}, {"uv_from_vertex", std::move(transform)}, {"set", slot.texcoord}};
    }

private:
    std::filesystem::path folder_;
    const Scene& scene_;
    std::set<int> written_;
};

json material_of(const Material& m, TextureFiles& textures) {
    json material = {{"name", m.name},
                     {"base_color", numbers_of(m.base_color)},
                     {"metalness", number_of(m.metalness)},
                     {"roughness", number_of(m.roughness)},
                     {"emission", numbers_of(m.emission)},
                     {"specular", number_of(m.specular)},
                     {"normal_scale", number_of(m.normal_scale)}};
    if (m.alpha_mode == AlphaMode::mask) material["alpha_cutoff"] = number_of(m.alpha_cutoff);
    textures.enter(material, "base_color_texture", m.base_color_texture);
    textures.enter(material, "metalness_roughness_texture", m.metalness_roughness_texture);
    textures.enter(material, "normal_texture", m.normal_texture);
    textures.enter(material, "specular_texture", m.specular_texture);
    if (has_own_dielectric_f0(m)) material["dielectric_f0"] = numbers_of(m.dielectric_f0 * m.specular_color);
    textures.enter(material, "dielectric_f0_texture", m.specular_color_texture);
    return material;
}

}  // namespace

void write_raw_floats(const std::filesystem::path& file, const HostImage& image) {
    static_assert(std::endian::native == std::endian::little);
    write_text(file, {reinterpret_cast<const char*>(image.values.data()), image.values.size() * sizeof(float)});
}

void write_hdr(const std::filesystem::path& file, const HostImage& rgb) {
    std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(rgb.extent.y) + " +X " +
                       std::to_string(rgb.extent.x) + "\n";
    for (size_t i = 0; i < rgb.pixel_count(); ++i) {
        const glm::vec3 color = rgb.rgb(i);
        int exponent = 0;
        const float most = std::max({color.x, color.y, color.z});
        std::frexp(most, &exponent);
        const bool is_black = most < 1e-32f;
        for (int c = 0; c < 3; ++c)  // a mantissa that rounds up to 256 has no code
            text += is_black ? '\0' : char(std::min(std::lround(std::ldexp(color[c], 8 - exponent)), 255L));
        text += is_black ? '\0' : char(exponent + 128);
    }
    write_text(file, text);
}

void write_raw_meshes(const std::filesystem::path& folder, const Scene& as_loaded, const ScenePose& pose,
                      const std::vector<std::string>& names) {
    Scene storage;
    const Scene& scene = with_posed_meshes(as_loaded, pose, storage);
    TextureFiles textures(folder, scene);
    json all = {{"materials", json::array()}, {"meshes", json::array()}, {"nodes", json::object()}};
    for (const Material& material : scene.materials) all["materials"].push_back(material_of(material, textures));
    for (const Mesh& mesh : scene.meshes) all["meshes"].push_back(mesh_of(mesh));
    for (size_t i = 0; i < names.size(); ++i) {
        const unsigned mesh = scene.instances[i].mesh;
        all["nodes"][names[i]] = {{"mesh", mesh}, {"material", scene.meshes[mesh].material}};
    }
    write_text(folder / "scene.meshes.json", all.dump() + "\n");
}
