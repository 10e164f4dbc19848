#include "core/scene/content_hash.h"

#include "core/files.h"
#include "core/scene/texture_slots.h"

namespace {
struct SceneHash {
    ContentHash hash;

    void add(float value) { hash.add(value); }
    void add(unsigned value) { hash.add(value); }
    void add(int value) { hash.add(value); }
    template <int N, class T>
    void add(const glm::vec<N, T>& value) {
        for (int i = 0; i < N; ++i) add(value[i]);
    }
    template <int C, int R>
    void add(const glm::mat<C, R, float>& value) {
        for (int i = 0; i < C; ++i) add(value[i]);
    }
    template <class T>
    void add(const std::vector<T>& list) {
        hash.add(list.size());
        for (const T& element : list) add(element);
    }
    template <class... T>
    void all(const T&... values) {
        (add(values), ...);
    }
    /// The bytes of a list of elements without padding, preceded by their number.
    template <class T>
    void add_bytes(const std::vector<T>& values) {
        hash.add(values.size());
        hash.add(std::as_bytes(std::span(values)));
    }

    void add(const Texture& t) {
        add(t.extent);
        add_bytes(*t.rgba);
        all(int(t.is_srgb), int(t.wrap_u), int(t.wrap_v), int(t.is_nearest));
        if (t.channel_bytes != Texture().channel_bytes) add(t.channel_bytes);
    }
    void add(const TextureSlot& slot) { all(slot.texture, slot.texcoord, slot.uv_transform); }
    void add(const Material& m) {
        all(m.base_color, m.emission, m.alpha, m.metalness, m.roughness, m.normal_scale, m.specular, m.alpha_cutoff);
        all(m.base_color_texture, m.metalness_roughness_texture, m.normal_texture, m.emission_texture);
        all(int(m.alpha_mode), int(m.is_double_sided), int(m.is_unlit));
        if (m.specular_texture.texture >= 0) add(m.specular_texture);
        if (has_own_dielectric_f0(m)) all(m.dielectric_f0, m.specular_color, m.specular_color_texture);
    }
    void add(const Mesh& mesh) {
        static_assert(sizeof(Vertex) == 18 * sizeof(float), "Vertex is hashed as bytes, so it must have no padding");
        add_bytes(mesh.vertices);
        add_bytes(mesh.indices);
        add(mesh.material);
        if (mesh.targets.empty() && mesh.joint_weights.empty()) return;
        hash.add(std::string_view("deforms"));
        add(int(mesh.is_flat_shaded));
        add(mesh.targets);
        static_assert(sizeof(JointWeight) == 2 * sizeof(float));
        add(mesh.joints_per_vertex);
        add_bytes(mesh.joint_weights);
    }
    void add(const MorphTarget& target) {
        for (const auto* deltas : {&target.positions, &target.normals, &target.tangents}) add_bytes(*deltas);
    }
    void add(const Skin& skin) {
        add_bytes(skin.joints);
        add_bytes(skin.joint_from_mesh);
    }
    void add(const Node& n) {
        all(n.parent, n.parent_from_node, n.translation, n.rotation, n.scale);
        if (n.weights.empty()) return;
        hash.add(std::string_view("weights"));
        add_bytes(n.weights);
    }
    void add(const Instance& instance) {
        all(instance.mesh, instance.node);
        if (instance.skin < 0 && instance.weights_node < 0) return;
        hash.add(std::string_view("skin"));
        all(instance.skin, instance.weights_node);
    }
    void add(const AnimationChannel& channel) {
        all(int(channel.property), channel.node, int(channel.interpolation));
        if (channel.property == AnimationChannel::Property::weight) add(channel.target);
        add_bytes(channel.times);
        add_bytes(channel.values);
    }
    void add(const PunctualLight& l) {
        all(int(l.type), l.intensity, l.range, l.inner_cone_cos, l.outer_cone_cos, l.position, l.direction, l.node);
    }
    void add(const Environment& e) {
        all(int(e.type), e.color, e.slope, e.axis, e.latlong.extent);
        add_bytes(e.latlong.values);
        add(e.rotation);
    }
};
}  // namespace

std::string content_hash(const Scene& scene) {
    SceneHash hash;
    hash.all(scene.textures, scene.materials, scene.meshes, scene.nodes, scene.instances, scene.animation, scene.lights,
             scene.environment);
    if (!scene.skins.empty()) hash.add(scene.skins);
    if (!scene.animation.empty()) hash.add(scene.frame_rate);
    if (scene.hides_backs()) hash.hash.add(std::string("backs are hidden"));
    return hash.hash.hex();
}
