#include "core/gbuffer/drawn_scene.h"

#include "core/scene/deform.h"
#include "core/scene/texture_slots.h"
#include "core/scene/transform.h"
#include "core/shared/drawn_scene.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cstring>
#include <utility>

namespace {

constexpr unsigned floats_of_triangle = 4;  // that a vertex leads
static_assert(sizeof(Vertex) == (vertex_stride - floats_of_triangle) * sizeof(float),
              "mesh.vert reads vertices as plain floats");

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

const TextureSlot& slot_of(const Material& material, unsigned slot) {
    using M = Material;  // in the order of slot_base_color ... slot_specular_color
    constexpr TextureSlot Material::*slots[] = {&M::base_color_texture, &M::metalness_roughness_texture,
                                                &M::normal_texture,     &M::emission_texture,
                                                &M::specular_texture,   &M::specular_color_texture};
    return material.*slots[slot];
}

const char* const slot_names[] = {"base_color_texture", "metalness_roughness_texture",
                                  "normal_texture",     "emission_texture",
                                  "specular_texture",   "specular_color_texture"};
constexpr unsigned slot_count = std::size(slot_names);

uint32_t sampling_of(const Scene& scene, const TextureSlot& slot) {
    if (slot.texture < 0) return 0;
    const Texture& texture = scene.textures[slot.texture];
    return sampling_has_texture | (texture.is_srgb ? sampling_is_srgb : 0) |
           (texture.is_nearest ? sampling_is_nearest : 0) | uint32_t(texture.wrap_u) << sampling_wrap_u_shift |
           uint32_t(texture.wrap_v) << sampling_wrap_v_shift;
}

/// Of a texture of 16 bits, for which Vulkan promises no format.
HostImage values_of(const Texture& texture) {
    HostImage values(texture.extent, 4);
    for (size_t i = 0; i < values.values.size(); ++i) {
        uint16_t code;
        std::memcpy(&code, &(*texture.rgba)[i * sizeof code], sizeof code);
        values.values[i] = float(code) / 65535.0f;
    }
    return values;
}

DrawnMaterial drawn(const Scene& scene, const Material& m) {
    DrawnMaterial result{
        .base_color = {m.base_color, m.alpha},
        .factors = {m.metalness, m.roughness, m.normal_scale, m.alpha_mode == AlphaMode::mask ? m.alpha_cutoff : 0.0f},
        .emission = {m.emission, m.specular},
        .specular_color = {m.dielectric_f0 * m.specular_color, 0.0f},
        .flags = {m.is_unlit, m.is_double_sided, 0, 0}};
    for (unsigned slot = 0; slot < slot_count; ++slot) {
        const TextureSlot& source = slot_of(m, slot);
        const glm::mat3 rows = glm::transpose(source.uv_transform);
        result.slot_u[slot] = {rows[0], float(source.texcoord)};
        result.slot_v[slot] = {rows[1], 0.0f};
        result.sampling[slot / 4][slot % 4] = sampling_of(scene, source);
    }
    return result;
}

}  // namespace

DrawnScene::DrawnScene(PassList& pass_list, const Scene& scene, bool has_dielectric_f0, bool keep_all)
    : pass_list_(pass_list), scene_(scene), has_dielectric_f0_(has_dielectric_f0), keep_all_(keep_all) {
    if (scene.instances.empty()) return;
    std::vector<DrawnMaterial> materials;
    for (const Material& material : scene.materials) materials.push_back(drawn(scene, material));
    materials_ = pass_list.buffer("Materials", materials.size() * sizeof(DrawnMaterial));
    pass_list.upload(materials_, bytes_of(materials));
    instances_ = pass_list.buffer("Instances", scene.instances.size() * sizeof(DrawnInstance));

    std::vector<MeshBuffers> buffers(scene.meshes.size());
    std::vector<std::shared_ptr<const LeadingVertices>> leading(scene.meshes.size());
    for (unsigned i = 0; i < scene.instances.size(); ++i) {
        const unsigned index = scene.instances[i].mesh;
        const Mesh& mesh = scene.meshes[index];
        if (mesh.indices.empty()) continue;
        if (!leading[index]) {
            leading[index] = std::make_shared<const LeadingVertices>(find_leading_vertices(mesh));
            buffers[index].indices = upload_indices(*leading[index], index);
        }
        MeshBuffers of_instance = buffers[index];
        if (deforms(scene, scene.instances[i])) {
            const size_t floats = leading[index]->source.size() * (vertex_stride + 3);
            of_instance.vertices = pass_list.buffer("Vertices_of_instance" + std::to_string(i), floats * sizeof(float));
            deformed_.push_back({.instance = i, .leading = leading[index], .vertices = of_instance.vertices});
            deformed_.back().floats.resize(floats);
        } else {
            if (!buffers[index].vertices.storage)
                buffers[index].vertices = upload_vertices(mesh, *leading[index], index);
            of_instance.vertices = buffers[index].vertices;
        }
        const Kind kind = kind_of(scene.materials[mesh.material]);
        draws_[size_t(kind)].push_back(make_draw(i, of_instance, kind));
    }
}

DrawnScene::Kind DrawnScene::kind_of(const Material& material) const {
    if (keep_all_ || material.alpha_mode == AlphaMode::mask) return Kind::masked;
    const bool has_texture =
        std::ranges::any_of(texture_slots(material), [](const TextureSlot* slot) { return slot->texture >= 0; });
    return has_texture || has_dielectric_f0_ ? Kind::textured : Kind::plain;
}

Buffer DrawnScene::upload_indices(const LeadingVertices& leading, size_t mesh) {
    const Buffer buffer =
        pass_list_.buffer("Indices" + std::to_string(mesh), leading.indices.size() * sizeof(uint32_t));
    pass_list_.upload(buffer, bytes_of(leading.indices));
    return buffer;
}

Buffer DrawnScene::upload_vertices(const Mesh& mesh, const LeadingVertices& leading, size_t index) {
    std::vector<float> floats(leading.source.size() * vertex_stride);
    for (size_t v = 0; v < leading.source.size(); ++v) {
        std::memcpy(&floats[v * vertex_stride], &mesh.vertices[leading.source[v]], sizeof(Vertex));
        float* const of_triangle = &floats[(v + 1) * vertex_stride - floats_of_triangle];
        std::memcpy(of_triangle, &leading.triangle_normal[v], sizeof(glm::vec3));
        of_triangle[3] = leading.triangle_alpha[v];
    }
    const Buffer buffer = pass_list_.buffer("Vertices" + std::to_string(index), floats.size() * sizeof(float));
    pass_list_.upload(buffer, bytes_of(floats));
    return buffer;
}

void DrawnScene::pose(DeformedInstance& deformed, const ScenePose& pose, const ScenePose& previous) {
    const auto posed_as = [&](const ScenePose& at, std::vector<Vertex>& vertices) {
        std::vector<Vertex> storage = std::move(vertices);
        const std::span<const Vertex> posed = posed_vertices(scene_, at, deformed.instance, storage);
        if (posed.data() != storage.data()) storage.assign(posed.begin(), posed.end());
        vertices = std::move(storage);
    };
    // Frames mostly follow each other: what was posed for the one before is there already.
    std::swap(deformed.posed, deformed.before);
    if (deformed.before.empty() || deformed.deformation != previous.deformations[deformed.instance])
        posed_as(previous, deformed.before);
    deformed.deformation = pose.deformations[deformed.instance];
    if (deformed.deformation == previous.deformations[deformed.instance])
        deformed.posed = deformed.before;
    else
        posed_as(pose, deformed.posed);

    const LeadingVertices& leading = *deformed.leading;
    const size_t count = leading.source.size();
    std::vector<float>& floats = deformed.floats;
    tbb::parallel_for(size_t(0), count, [&](size_t v) {
        std::memcpy(&floats[v * vertex_stride], &deformed.posed[leading.source[v]], sizeof(Vertex));
        floats[(v + 1) * vertex_stride - 1] = leading.triangle_alpha[v];
        std::memcpy(&floats[count * vertex_stride + 3 * v], &deformed.before[leading.source[v]].position,
                    sizeof(glm::vec3));
    });
    tbb::parallel_for(size_t(0), leading.indices.size() / 3, [&](size_t t) {
        const uint32_t* corner = &leading.indices[3 * t];
        const auto position = [&](int k) { return deformed.posed[leading.source[corner[k]]].position; };
        const glm::vec3 normal = triangle_normal(position(0), position(1), position(2));
        std::memcpy(&floats[(corner[0] + 1) * vertex_stride - floats_of_triangle], &normal, sizeof(glm::vec3));
    });
    pass_list_.upload(deformed.vertices, bytes_of(floats));
}

Image DrawnScene::texture_image(const TextureSlot& slot) {
    if (slot.texture < 0) {
        if (!no_texture_.storage) {
            no_texture_ = pass_list_.image_of("no_texture", Format::rgba8, {1, 1});
            pass_list_.upload_rgba8(no_texture_, std::vector<uint8_t>(4, 255));
        }
        return no_texture_;
    }
    const Texture& texture = scene_.textures[slot.texture];
    Image& image = images_[texture.rgba.get()];
    if (image.storage) return image;
    const std::string name = "texture" + std::to_string(slot.texture);
    if (texture.channel_bytes == 2) {
        image = pass_list_.image_of(name, Format::rgba32f, texture.extent);
        pass_list_.upload(image, values_of(texture));
    } else {
        image = pass_list_.image_of(name, Format::rgba8, texture.extent);
        pass_list_.upload_rgba8(image, *texture.rgba);
    }
    return image;
}

Draw DrawnScene::make_draw(unsigned instance, const MeshBuffers& buffers, Kind kind) {
    const Mesh& mesh = scene_.meshes[scene_.instances[instance].mesh];
    Draw draw{
        .indices = buffers.indices, .index_count = unsigned(mesh.indices.size() / 3 * 3), .first_instance = instance};
    draw.buffers = {buffers.vertices.as("Vertices"), instances_, materials_};
    draw.cull = cull_of(instance, false);
    if (kind == Kind::plain) return draw;
    for (unsigned slot = 0; slot < slot_count; ++slot)
        draw.reads.push_back({texture_image(slot_of(scene_.materials[mesh.material], slot)).as(slot_names[slot]), {}});
    return draw;
}

/// A mirrored instance shows its front where its corners run clockwise (glTF 2.0, section 3.7.4).
Draw::Cull DrawnScene::cull_of(unsigned instance, bool is_mirrored) const {
    const Material& material = scene_.materials[scene_.meshes[scene_.instances[instance].mesh].material];
    if (!scene_.hides_backs_of(material)) return Draw::Cull::none;
    return is_mirrored ? Draw::Cull::front : Draw::Cull::back;
}

void DrawnScene::pose(const ScenePose& pose, const ScenePose& previous) {
    if (scene_.instances.empty()) return;
    std::vector<uint32_t> previous_positions(scene_.instances.size(), 0);
    for (DeformedInstance& deformed : deformed_) {
        this->pose(deformed, pose, previous);
        previous_positions[deformed.instance] = uint32_t(deformed.leading->source.size()) * vertex_stride;
    }
    std::vector<DrawnInstance> instances;
    for (size_t i = 0; i < scene_.instances.size(); ++i) {
        const glm::mat4& world_from_object = pose.world_from_instance[i];
        const NormalTransform normals = normal_transform(world_from_object);
        instances.push_back(
            {.world_from_object = world_from_object,
             .previous_world_from_object = previous.world_from_instance[i],
             .normal_matrix = glm::mat4(normals.matrix),
             .ids = {scene_.meshes[scene_.instances[i].mesh].material, normals.is_mirrored, previous_positions[i], 0}});
    }
    pass_list_.upload(instances_, bytes_of(instances));
    for (std::vector<Draw>& draws : draws_)
        for (Draw& draw : draws) draw.cull = cull_of(draw.first_instance, instances[draw.first_instance].ids.y == 1);
}
