#include "core/scene/content_hash.h"

#include "core/files.h"

namespace {
void add(ContentHash& hash, float value) { hash.add(value); }
void add(ContentHash& hash, unsigned value) { hash.add(value); }
void add(ContentHash& hash, int value) { hash.add(value); }

template <int N, class T>
void add(ContentHash& hash, const glm::vec<N, T>& value) {
    for (int i = 0; i < N; ++i) add(hash, value[i]);
}

template <int C, int R>
void add(ContentHash& hash, const glm::mat<C, R, float>& value) {
    for (int i = 0; i < C; ++i) add(hash, value[i]);
}

/// The bytes of a list of elements without padding, preceded by their number.
template <class T>
void add_bytes(ContentHash& hash, const std::vector<T>& values) {
    hash.add(values.size());
    hash.add(std::as_bytes(std::span(values)));
}

void add(ContentHash& hash, const Texture& texture) {
    add(hash, texture.extent);
    add_bytes(hash, texture.rgba);
    for (const int value : {int(texture.is_srgb), int(texture.wrap_u), int(texture.wrap_v), int(texture.is_nearest)})
        add(hash, value);
}

void add(ContentHash& hash, const TextureSlot& slot) {
    add(hash, slot.texture);
    add(hash, slot.texcoord);
    add(hash, slot.uv_transform);
}

void add(ContentHash& hash, const Material& material) {
    add(hash, material.base_color);
    add(hash, material.emission);
    for (const float value : {material.alpha, material.metalness, material.roughness, material.normal_scale,
                              material.specular, material.alpha_cutoff})
        add(hash, value);
    for (const TextureSlot* slot : {&material.base_color_texture, &material.metalness_roughness_texture,
                                    &material.normal_texture, &material.emission_texture})
        add(hash, *slot);
    for (const int value : {int(material.alpha_mode), int(material.is_double_sided), int(material.is_unlit)})
        add(hash, value);
}

void add(ContentHash& hash, const Mesh& mesh) {
    static_assert(sizeof(Vertex) == 18 * sizeof(float), "Vertex is hashed as bytes, so it must have no padding");
    add_bytes(hash, mesh.vertices);
    add_bytes(hash, mesh.indices);
    add(hash, mesh.material);
}

void add(ContentHash& hash, const Node& node) {
    add(hash, node.parent);
    add(hash, node.parent_from_node);
    add(hash, node.translation);
    add(hash, node.rotation);
    add(hash, node.scale);
}

void add(ContentHash& hash, const Instance& instance) {
    add(hash, instance.mesh);
    add(hash, instance.node);
}

void add(ContentHash& hash, const AnimationChannel& channel) {
    add(hash, int(channel.property));
    add(hash, channel.node);
    add(hash, int(channel.interpolation));
    add_bytes(hash, channel.times);
    add_bytes(hash, channel.values);
}

void add(ContentHash& hash, const PunctualLight& light) {
    add(hash, int(light.type));
    add(hash, light.intensity);
    for (const float value : {light.range, light.inner_cone_cos, light.outer_cone_cos}) add(hash, value);
    add(hash, light.position);
    add(hash, light.direction);
    add(hash, light.node);
}

void add(ContentHash& hash, const Environment& environment) {
    add(hash, int(environment.type));
    add(hash, environment.color);
    add(hash, environment.slope);
    add(hash, environment.axis);
    add(hash, environment.latlong.extent);
    add_bytes(hash, environment.latlong.values);
    add(hash, environment.rotation);
}

template <class T>
void add(ContentHash& hash, const std::vector<T>& list) {
    hash.add(list.size());
    for (const T& element : list) add(hash, element);
}
}  // namespace

std::string content_hash(const Scene& scene) {
    ContentHash hash;
    add(hash, scene.textures);
    add(hash, scene.materials);
    add(hash, scene.meshes);
    add(hash, scene.nodes);
    add(hash, scene.instances);
    add(hash, scene.animation);
    add(hash, scene.lights);
    add(hash, scene.environment);
    if (!scene.animation.empty()) add(hash, scene.frame_rate);
    return hash.hex();
}
