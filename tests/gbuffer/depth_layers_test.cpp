// What lies behind the visible surface, against ray and triangle in double precision.
#include "core/gbuffer/gbuffer_transfer.h"
#include "tests/gbuffer/test_scenes.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <optional>

namespace {

enum MaterialIndex : unsigned { plain, textured, masked };

/// One texel is there, the other is a hole.
constexpr glm::uvec2 mask_extent(2, 1);

Scene empty_scene() {
    Scene scene{.name = "layers"};
    scene.textures = {{.name = "gray", .extent = {1, 1}, .rgba = make_texels({90, 90, 90, 255})},
                      {.name = "half",
                       .extent = mask_extent,
                       .rgba = make_texels({255, 255, 255, 255, 255, 255, 255, 0}),
                       .is_nearest = true}};
    scene.materials = {{.name = "plain"},
                       {.name = "textured", .base_color_texture = {0}},
                       {.name = "masked", .base_color_texture = {1}, .alpha_mode = AlphaMode::mask}};
    const SceneCamera camera{.name = "main",
                             .vertical_fov = 0.8f,
                             .near = 0.1f,
                             .far = 20,
                             .keys = {{0, {0.3f, 0.4f, 0.5f}, {0, 0.1f, -5}}}};
    SceneCamera orthographic = camera;
    orthographic.name = "orthographic", orthographic.is_orthographic = true, orthographic.orthographic_height = 3;
    scene.cameras = {camera, orthographic};
    return scene;
}

void add(Scene& scene, const Mesh& mesh) {
    scene.nodes.push_back({.name = mesh.name});
    scene.instances.push_back({unsigned(scene.meshes.size()), unsigned(scene.nodes.size() - 1)});
    scene.meshes.push_back(mesh);
}

void add_wall(Scene& scene, unsigned material = plain) {
    add(scene, quad(material, {-9, -9, -6}, {18, 0, 0}, {0, 18, 0}));
}

/// Its six sides face outwards.
void add_box(Scene& scene, glm::vec3 low, glm::vec3 high) {
    const glm::vec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
    for (const Mesh& side : {quad(plain, low, z, y), quad(plain, low + x, y, z), quad(plain, low, x, z),
                             quad(plain, low + y, z, x), quad(plain, low, y, x), quad(plain, low + z, x, y)})
        add(scene, side);
}

struct Crossing {
    double distance;  ///< along the camera's ray (m)
    double device_depth;
    bool is_back;
    size_t instance;
};

/// All surfaces along a camera ray, nearest first.
std::vector<Crossing> crossings(const Scene& scene, const CameraPose& pose, const CameraData& camera, glm::uvec2 extent,
                                glm::vec2 place) {
    const CameraRay ray = camera_ray(pose, extent, place);
    const glm::dvec3 origin(ray.origin), direction(ray.direction);
    std::vector<Crossing> found;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
        for (size_t first = 0; first < mesh.indices.size(); first += 3) {
            const Vertex* v[3];
            for (size_t c = 0; c < 3; ++c) v[c] = &mesh.vertices[mesh.indices[first + c]];
            const glm::dvec3 a(v[0]->position), ab = glm::dvec3(v[1]->position) - a,
                                                ac = glm::dvec3(v[2]->position) - a, normal = glm::cross(ab, ac);
            const double slope = glm::dot(normal, direction), distance = glm::dot(normal, a - origin) / slope;
            const glm::dvec3 point = origin + distance * direction;
            const double u = glm::dot(glm::cross(point - a, ac), normal) / glm::dot(normal, normal),
                         w = glm::dot(glm::cross(ab, point - a), normal) / glm::dot(normal, normal);
            if (slope == 0 || distance < pose.near || u < 0 || w < 0 || u + w > 1) continue;
            const double texture_u = (1 - u - w) * v[0]->uv[0].x + u * v[1]->uv[0].x + w * v[2]->uv[0].x;
            if (mesh.material == masked && texture_u > 0.5) continue;
            const glm::dvec4 clip = glm::dmat4(camera.clip_from_world) * glm::dvec4(point, 1);
            found.push_back({distance, clip.z / clip.w, slope > 0, i});
        }
    }
    std::ranges::sort(found, {}, &Crossing::distance);
    return found;
}

bool are_same_surfaces(const std::vector<Crossing>& a, const std::vector<Crossing>& b) {
    return std::ranges::equal(a, b, {}, &Crossing::instance, &Crossing::instance);
}

struct Seen {
    size_t solid = 0, sheets = 0, nothing_behind = 0, background = 0;  ///< pixels
};

struct Setting {
    const char* camera = "main";
    DepthDirection direction = DepthDirection::standard;
    DepthFormat format = DepthFormat::d32f;
    glm::vec2 jitter{0, 0};
};

HostGBuffer render(const Scene& scene, const Setting& setting, bool has_layers = true) {
    const RasterizerOptions options{.extent = {60, 45}, .depth_format = setting.format, .has_depth_layers = has_layers};
    FrameView view = view_of(options.extent, 0, setting.direction);
    view.jitter = setting.jitter;
    Rasterizer rasterizer(test_device(), scene, options);
    const GBuffer gbuffer = rasterizer.render(scene.camera(setting.camera), view);
    return download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), options.depth_format);
}

/// Fails where a pixel's layers are not those of its ray.
Seen expect_layers(const Scene& scene, const Setting& setting) {
    const HostGBuffer g = render(scene, setting);
    const CameraPose pose = pose_camera(scene.camera(setting.camera), pose_scene(scene, 0), 0);
    const float far_plane = setting.direction == DepthDirection::reversed ? 0.0f : 1.0f;
    Seen seen;
    for (unsigned y = 0; y < g.extent().y; ++y)
        for (unsigned x = 0; x < g.extent().x; ++x) {
            const auto at = [&](glm::vec2 off) {
                return crossings(scene, pose, g.camera, g.extent(), glm::vec2(x, y) + 0.5f + setting.jitter + off);
            };
            const std::vector<Crossing> here = at({0, 0});
            // Vertices are snapped to 1/256 of a pixel, which may turn a pixel that an edge is so near to, and moves
            // slanted surfaces by as much: a fiftieth of a pixel holds it with the roundings of interpolation.
            double tolerance = 4 * 0x1p-24;
            bool is_at_edge = false;
            for (const glm::vec2 off : {glm::vec2(0.02f, 0), {-0.02f, 0}, {0, 0.02f}, {0, -0.02f}}) {
                const std::vector<Crossing> beside = at(off);
                is_at_edge = is_at_edge || !are_same_surfaces(here, beside);
                if (!is_at_edge && here.size() >= 2)
                    tolerance = std::max(tolerance, std::abs(beside[1].device_depth - here[1].device_depth));
            }
            if (is_at_edge) continue;
            const float depth = *g.depth.pixel(x, y), second = *g.second_depth.pixel(x, y),
                        back = *g.back_depth.pixel(x, y);
            const std::string where = std::to_string(x) + ", " + std::to_string(y);
            if (here.size() < 2) {
                ++(here.empty() ? seen.background : seen.nothing_behind);
                EXPECT_EQ(second, far_plane) << where;
                EXPECT_EQ(back, depth) << where;
            } else if (here[1].is_back) {
                ++seen.solid;
                EXPECT_NEAR(second, here[1].device_depth, tolerance) << where;
                EXPECT_EQ(back, second) << where;
            } else {
                ++seen.sheets;
                EXPECT_NEAR(second, here[1].device_depth, tolerance) << where;
                EXPECT_EQ(back, depth) << where;
            }
            if (testing::Test::HasFailure()) return seen;  // one pixel is enough
        }
    return seen;
}

std::vector<Setting> settings() {
    std::vector<Setting> all;
    for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed})
        for (const DepthFormat format : {DepthFormat::d32f, DepthFormat::d16})
            all.push_back({"main", direction, format});
    all.push_back({.camera = "orthographic"});
    all.push_back({.direction = DepthDirection::reversed, .jitter = {0.3f, -0.2f}});
    return all;
}

}  // namespace

TEST(DepthLayers, AClosedBoxEndsAtItsFarSide) {
    Scene scene = empty_scene();
    add_box(scene, {-0.6f, -0.4f, -4}, {0.6f, 0.5f, -3});
    add_wall(scene);
    for (const Setting& setting : settings()) {
        const Seen seen = expect_layers(scene, setting);
        EXPECT_GT(seen.solid, 200u);
        EXPECT_GT(seen.nothing_behind, 1000u) << "the wall beside the box";
    }
}

TEST(DepthLayers, TheFarSideOfABoxAheadHasTheDepthOfItsDistance) {
    // Without the oracle of the other tests: the camera looks along an axis.
    Scene scene = empty_scene();
    scene.cameras[0].keys = {{0, {0, 0, 0}, {0, 0, -1}}};
    add_box(scene, {-0.6f, -0.6f, -4}, {0.6f, 0.6f, -3});
    add_wall(scene);
    const HostGBuffer g = render(scene, {});
    const double near = 0.1, far = 20, expected = far / (far - near) * (1 - near / 4.0);  // Vulkan's clip space
    EXPECT_NEAR(*g.second_depth.pixel(30, 22), expected, 4 * 0x1p-24) << "some roundings of values near 1";
    EXPECT_EQ(*g.back_depth.pixel(30, 22), *g.second_depth.pixel(30, 22));
}

TEST(DepthLayers, ASheetEndsWhereItBegins) {
    for (const bool shows_front : {true, false}) {
        Scene scene = empty_scene();
        const glm::vec3 u(1.2f, 0, 0.3f), v(0, 1.3f, 0);
        add(scene, quad(plain, {-0.6f, -0.6f, -3}, shows_front ? u : v, shows_front ? v : u));
        add_wall(scene, textured);
        for (const Setting& setting : settings()) {
            const Seen seen = expect_layers(scene, setting);
            EXPECT_GT(seen.sheets, 200u);
            EXPECT_EQ(seen.solid, 0u);
        }
    }
}

TEST(DepthLayers, BehindTheLastSurfaceLiesTheFarPlane) {
    Scene scene = empty_scene();
    add(scene, quad(plain, {-0.6f, -0.6f, -3}, {1.2f, 0, 0}, {0, 1.2f, 0}));
    for (const Setting& setting : settings()) {
        const Seen seen = expect_layers(scene, setting);
        EXPECT_GT(seen.nothing_behind, 200u);
        EXPECT_GT(seen.background, 1000u);
        EXPECT_EQ(seen.sheets + seen.solid, 0u);
    }
}

TEST(DepthLayers, HolesOfAMaskAreNoSurface) {
    // A mask before a box: through its hole the box is seen, and what lies behind that is the box's back.
    Scene before = empty_scene();
    add(before, quad(masked, {-0.6f, -0.6f, -2}, {1.2f, 0, 0}, {0, 1.2f, 0}));
    add_box(before, {-0.6f, -0.4f, -4}, {0.6f, 0.5f, -3});
    add_wall(before);
    // A sheet before a mask: through its hole the wall is next.
    Scene behind = empty_scene();
    add(behind, quad(plain, {-0.6f, -0.6f, -2}, {1.2f, 0, 0}, {0, 1.2f, 0}));
    add(behind, quad(masked, {-0.6f, -0.6f, -3}, {1.2f, 0, 0}, {0, 1.2f, 0}));
    add_wall(behind);
    for (const Setting& setting : settings()) {
        const Seen seen = expect_layers(before, setting);
        EXPECT_GT(seen.solid, 75u) << "through the hole";
        EXPECT_GT(seen.sheets, 75u) << "the mask before the box";
        EXPECT_GT(expect_layers(behind, setting).sheets, 200u);
    }
}

TEST(DepthLayers, NoSurfaceLiesBehindItself) {
    // Slanted, as rounding hits every depth: a floor to the horizon, which nothing lies behind.
    Scene scene = empty_scene();
    add(scene, quad(plain, {-30, -0.5f, 0}, {60, 0, 0}, {0, 0, -19}));
    add(scene, quad(textured, {-30, 1.4f, 0}, {60, 0.7f, 0}, {0, 0.3f, -19}));
    for (const Setting& setting : settings()) {
        const Seen seen = expect_layers(scene, setting);
        EXPECT_GT(seen.nothing_behind, 1000u);
        EXPECT_EQ(seen.sheets + seen.solid, 0u);
    }
}

TEST(DepthLayers, AreThereOnlyWhereTheyAreAskedForAndTravelWithTheOthers) {
    Scene scene = empty_scene();
    add_box(scene, {-0.6f, -0.4f, -4}, {0.6f, 0.5f, -3});
    add_wall(scene);
    const HostGBuffer without = render(scene, {}, false), with = render(scene, {});
    EXPECT_TRUE(without.second_depth.values.empty() && without.back_depth.values.empty());
    EXPECT_EQ(differing_bits(with.depth, without.depth), 0u);
    EXPECT_NE(differing_bits(with.back_depth, with.second_depth), 0u);

    PassList pass_list(test_device(), with.extent());
    const GBuffer uploaded = upload_gbuffer(pass_list, with);
    const HostGBuffer again = download_gbuffer(pass_list, uploaded, with.camera, with.depth_format);
    EXPECT_EQ(differing_bits(again.second_depth, with.second_depth), 0u);
    EXPECT_EQ(differing_bits(again.back_depth, with.back_depth), 0u);
    EXPECT_FALSE(upload_gbuffer(pass_list, without).second_depth.storage);
}
