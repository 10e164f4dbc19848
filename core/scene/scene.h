#pragma once
#include "core/host_image.h"
#include "core/reading_limits.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// A scene as glTF describes it, free of Vulkan and Embree: the rasteriser and the path tracer read the same structs.
/// World space is right-handed, +Y up, in metres; colours are linear Rec.709.

enum class TextureWrap { repeat, mirrored_repeat, clamp_to_edge };

/// RGBA texels, row by row, as bytes; see Texture::channel_bytes. Those of one image are held once, however many
/// textures show it.
using Texels = std::shared_ptr<const std::vector<uint8_t>>;

inline Texels make_texels(std::vector<uint8_t> rgba) {
    return std::make_shared<const std::vector<uint8_t>>(std::move(rgba));
}

/// Row 0 at v = 0 (glTF: top). Both renderers filter level 0 bilinearly, so that a pixel means the same in both.
struct Texture {
    std::string name;
    glm::uvec2 extent{0, 0};
    Texels rgba;                 ///< never null in a Scene
    unsigned channel_bytes = 1;  ///< of a texel's channel: 1, or 2 of 16-bit images, in the machine's byte order
    bool is_srgb = false;        ///< RGB are sRGB codes, decoded before filtering; alpha is linear
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    bool is_nearest = false;
};

/// Which texture a material channel reads, and where. Sampled at (uv_transform * vec3(uv[texcoord], 1)).xy.
struct TextureSlot {
    int texture = -1;  ///< index into Scene::textures; -1: none
    unsigned texcoord = 0;
    glm::mat3 uv_transform{1.0f};  ///< KHR_texture_transform
};

enum class AlphaMode { opaque, mask };

/// glTF 2.0 metallic-roughness (Appendix B). Factors multiply their textures. A G-buffer has one layer: BLEND becomes a
/// mask or opaque (cut_blended_materials()), and transmission is opaque, unless scene.json hides the material.
struct Material {
    std::string name;
    glm::vec3 base_color{1.0f};
    float alpha = 1.0f;
    TextureSlot base_color_texture;            ///< RGB base colour, A alpha
    float metalness = 1.0f, roughness = 1.0f;  ///< roughness is perceptual: alpha_ggx = roughness^2
    TextureSlot metalness_roughness_texture;   ///< G roughness, B metalness
    TextureSlot normal_texture;
    float normal_scale = 1.0f;
    TextureSlot occlusion_texture;  ///< listed only: both renderers solve for occlusion or leave it out
    glm::vec3 emission{0.0f};       ///< radiance (W sr^-1 m^-2): emissiveFactor times KHR_materials_emissive_strength
    TextureSlot emission_texture;
    float specular = 1.0f;           ///< KHR_materials_specular's specularFactor: scales the dielectric Fresnel term
    TextureSlot specular_texture;    ///< A: multiplies `specular`
    glm::vec3 specular_color{1.0f};  ///< specularColorFactor: scales `dielectric_f0`, at most to 1
    TextureSlot specular_color_texture;  ///< RGB: multiplies `specular_color`
    float dielectric_f0 = 0.04f;  ///< reflectance at normal incidence, of the index of refraction (KHR_materials_ior)
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;     ///< a hit counts where alpha >= cutoff (AlphaMode::mask)
    bool is_double_sided = false;  ///< else the back emits nothing, and Scene::draws_backs says whether it is seen
    bool is_unlit = false;         ///< KHR_materials_unlit: radiates its base colour and reflects nothing
};

struct Vertex {
    glm::vec3 position, normal;  ///< object space; normal has unit length
    glm::vec4 tangent;           ///< xyz unit, w = +-1: bitangent = w * cross(normal, tangent)
    glm::vec2 uv[2];
    glm::vec4 color;  ///< COLOR_0, multiplies base colour and alpha; 1 if absent
};

/// What weight 1 of a morph target adds to each vertex of its mesh (glTF 2.0, section 3.7.2.2), in object space; an
/// empty list adds nothing.
struct MorphTarget {
    std::vector<glm::vec3> positions, normals, tangents;
};

/// How far a vertex follows a joint of its instance's skin.
struct JointWeight {
    uint32_t joint = 0;  ///< index into Skin::joints
    float weight = 0.0f;
};

/// One glTF primitive, always indexed triangles. Shared by all its instances.
struct Mesh {
    std::string name;
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
    unsigned material = 0;
    bool is_flat_shaded = false;  ///< its normals are those of its triangles, also where they are deformed
    std::vector<MorphTarget> targets;
    unsigned joints_per_vertex = 0;
    std::vector<JointWeight> joint_weights;  ///< `joints_per_vertex` of each vertex, which sum to 1
};

/// The joints that instances follow in place of their node (glTF 2.0, section 3.7.3).
struct Skin {
    std::vector<unsigned> joints;            ///< indices into Scene::nodes
    std::vector<glm::mat4> joint_from_mesh;  ///< inverse bind matrices, one per joint
};

/// A node that draws a mesh.
struct Instance {
    unsigned mesh = 0, node = 0;
    int skin = -1;          ///< index into Scene::skins; -1: the mesh stands as its node does
    int weights_node = -1;  ///< the node whose morph weights it has; -1: `node`
};

enum class LightType { directional, point, spot };

/// KHR_lights_punctual. In a posed frame `position` and `direction` are in world space.
struct PunctualLight {
    std::string name;
    LightType type = LightType::point;
    /// Colour times irradiance at normal incidence (directional, W m^-2), or radiant intensity (W sr^-1).
    glm::vec3 intensity{1.0f};
    float range = 0.0f;  ///< m; 0: unlimited. The smooth window of the extension is applied by both renderers.
    float inner_cone_cos = 1.0f, outer_cone_cos = 0.70710678f;  ///< spot
    glm::vec3 position{0.0f}, direction{0.0f, 0.0f, -1.0f};     ///< direction: that in which the light travels
    int node = -1;  ///< poses position and direction; -1: they are in world space already
};

/// Radiance that arrives from infinity along a direction d (pointing away from the scene).
struct Environment {
    enum class Type { constant, gradient, image } type = Type::constant;
    glm::vec3 color{0.0f};             ///< constant: the radiance. gradient: the radiance at the equator of `axis`
    glm::vec3 slope{0.0f};             ///< gradient: radiance = max(0, color + slope * dot(d, axis))
    glm::vec3 axis{0.0f, 1.0f, 0.0f};  ///< unit
    HostImage latlong;      ///< image: RGB, already times the scale; see core/shared/environment.h for its mapping
    float rotation = 0.0f;  ///< image: about +Y (radians)

    bool is_black() const;                          ///< in every direction
    glm::vec3 radiance(glm::vec3 direction) const;  ///< direction: unit, world space
    glm::vec3 image_radiance(glm::vec2 uv) const;   ///< image: radiance() of the direction of an environment_uv()
};

/// Where a camera is at a frame. Between keys position and target are linear in the frame number.
struct CameraKey {
    float frame = 0.0f;
    glm::vec3 position{0.0f}, target{0.0f, 0.0f, -1.0f}, up{0.0f, 1.0f, 0.0f};
};

struct SceneCamera {
    std::string name;
    bool is_orthographic = false;
    float vertical_fov = 0.87f;        ///< radians, perspective
    float orthographic_height = 1.0f;  ///< m, full height of the view
    float aspect = 0.0f;               ///< width over height of the frame that its author saw; 0: none was named
    float near = 0.1f, far = 100.0f;   ///< m
    std::vector<CameraKey> keys;       ///< one: static
    int node = -1;                     ///< the glTF node that poses it in place of `keys`
    float exposure_ev = 0.0f;          ///< for display: pixels are multiplied by 2^ev
    unsigned frame_count = 1;          ///< length of its path
};

/// glTF node: a transform below a parent, possibly animated. World matrices keep their sign: where the determinant of
/// an instance's is negative, both renderers take the clockwise side of its triangles as the front (glTF 2.0,
/// section 3.7.4).
struct Node {
    std::string name;
    int parent = -1;
    glm::mat4 parent_from_node{1.0f};  ///< at rest
    /// Its parts, of which animation replaces some: parent_from_node = translation * rotation * scale.
    glm::vec3 translation{0.0f};
    glm::vec4 rotation{0.0f, 0.0f, 0.0f, 1.0f};  ///< unit quaternion xyzw
    glm::vec3 scale{1.0f};
    std::vector<float> weights;  ///< of the morph targets of the meshes that it draws
};

enum class Interpolation { step, linear, cubic_spline };

/// One glTF animation channel: keys of one property of one node.
struct AnimationChannel {
    enum class Property { translation, rotation, scale, weight } property{};
    unsigned node = 0;
    unsigned target = 0;  ///< weight: the morph target's, which is the x of the values
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;       ///< s, ascending
    std::vector<glm::vec4> values;  ///< rotation: quaternion xyzw; cubic_spline: in-tangent, value, out-tangent per key
};

/// One of the animations that a file holds, of which not all need be played.
struct AnimationClip {
    std::string name;
    bool is_played = false;
};

/// One sentence about something that ssrlab shows differently from the file, or that it chose for the file.
struct SceneWarning {
    std::string text;
    int material = -1, node = -1;  ///< indices into Scene::materials and Scene::nodes; -1: none in particular

    auto operator<=>(const SceneWarning&) const = default;
};

struct Scene {
    std::string name;   ///< that of its folder
    std::string asset;  ///< the glTF that it shows, where others may show it, too; else its own name
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;  ///< parents before children
    std::vector<Skin> skins;
    std::vector<Instance> instances;
    std::vector<AnimationChannel> animation;  ///< of the clips that are played
    std::vector<AnimationClip> clips;         ///< all of the files
    std::vector<PunctualLight> lights;
    Environment environment;
    std::vector<SceneCamera> cameras;
    unsigned frame_count = 1;
    float frame_rate = 30.0f;  ///< frames per second of animation time
    std::vector<SceneWarning> warnings;
    bool draws_backs = true;   ///< single-sided surfaces are seen from behind, too, against glTF 2.0, section 3.9.5
    std::string content_hash;  ///< of every file and override that the rendered light depends on
    MemoryShare memory = {};   ///< that of textures, meshes and the environment

    const SceneCamera& camera(const std::string& name) const;  ///< "": the first; Error with a near miss if unknown
    size_t triangle_count() const;                             ///< over all instances
    /// Whether cameras, reflections and shadows do not see the backs of the material's surfaces.
    bool hides_backs_of(const Material& material) const { return !draws_backs && !material.is_double_sided; }
    bool hides_backs() const;  ///< of anything that is drawn
};

/// What moves the vertices of an instance at one instant; both are empty where its mesh keeps its shape.
struct Deformation {
    std::vector<glm::mat4> instance_from_mesh;  ///< per joint of its skin
    std::vector<float> weights;                 ///< per morph target of its mesh

    bool operator==(const Deformation&) const = default;
};

/// The scene at one instant: what moves, in world space.
struct ScenePose {
    /// One per Scene::instances. If joints place the vertices: the identity, or a mirroring if the skin's first joint
    /// mirrors.
    std::vector<glm::mat4> world_from_instance;
    std::vector<Deformation> deformations;  ///< one per Scene::instances; none where all meshes keep their shapes
    std::vector<glm::mat4> world_from_node;
    std::vector<PunctualLight> lights;
};

/// `frame` may be fractional; time = frame / frame_rate. Beyond the last key of an animation the last key holds.
ScenePose pose_scene(const Scene& scene, float frame);

/// Axis-aligned bounds of all instances in world space; empty scene: min = max = 0.
std::array<glm::vec3, 2> scene_bounds(const Scene& scene, const ScenePose& pose);
