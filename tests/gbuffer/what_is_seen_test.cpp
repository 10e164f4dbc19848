// What of a scene the cameras of both renderers see: between planes, from the front, and through masks.
#include "tests/gbuffer/agreement.h"

#include "core/gbuffer/gbuffer_transfer.h"
#include "groundtruth/paths/path_tracer.h"
#include "groundtruth/paths/plane_cuts.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

constexpr glm::uvec2 extent(160, 120);

/// Material + 1 of every pixel, 0: nothing.
struct Seen {
    std::vector<unsigned> rasterised, traced;

    size_t count(unsigned id) const {
        EXPECT_EQ(std::ranges::count(rasterised, id), std::ranges::count(traced, id));
        return size_t(std::ranges::count(traced, id));
    }
};

Seen seen(const Scene& scene, const SceneCamera& camera, const RasterizerOptions& options = {}) {
    RasterizerOptions sized = options;
    sized.extent = extent;
    Rasterizer rasterizer(test_device(), scene, sized);
    const GBuffer gbuffer = rasterizer.render(camera, view_of(extent));
    const HostGBuffer host = download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), DepthFormat::d32f);
    const ScenePose pose = pose_scene(scene, 0);
    const PathTracer tracer(scene, pose, pose_camera(camera, pose, 0), extent, {});
    Seen result;
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const FirstHit hit = tracer.first_hit(x, y);
            result.rasterised.push_back(unsigned(*host.material_id.pixel(x, y)));
            result.traced.push_back(hit.is_hit ? hit.material + 1 : 0);
        }
    return result;
}

/// Squares of 8 x 8 m across the view at the depths, each of its own material; the nearest first.
Scene walls(const std::vector<float>& depths) {
    Scene scene{.name = "walls"};
    for (const float depth : depths) {
        scene.nodes.push_back({.name = "wall"});
        scene.instances.push_back({unsigned(scene.meshes.size()), unsigned(scene.nodes.size() - 1)});
        scene.meshes.push_back(quad(unsigned(scene.materials.size()), {-4, -4, -depth}, {8, 0, 0}, {0, 8, 0}));
        scene.materials.push_back({.name = "wall", .metalness = 0, .roughness = 0.5f});
    }
    return scene;
}

SceneCamera looking_ahead(float near, float far) {
    return {.name = "main", .vertical_fov = 0.8f, .near = near, .far = far, .keys = {CameraKey{}}};
}

}  // namespace

TEST(what_is_seen, lies_between_the_planes) {
    const Scene scene = walls({1, 2, 3});
    for (const bool is_orthographic : {false, true})
        for (const auto& [near, far, id] :
             {std::tuple(0.5f, 10.0f, 1u), {1.5f, 10.0f, 2u}, {2.5f, 10.0f, 3u}, {3.5f, 10.0f, 0u}, {0.5f, 0.9f, 0u}}) {
            SceneCamera camera = looking_ahead(near, far);
            camera.is_orthographic = is_orthographic, camera.orthographic_height = 3;
            EXPECT_EQ(seen(scene, camera).count(id), size_t(extent.x) * extent.y) << near << " to " << far;
        }
}

/// Planes are depths, not distances: a near plane of 1.9 m leaves the corners of a wall at 2 m, where rays come from
/// 2.5 m, and one of 2.1 m takes all of it.
TEST(what_is_seen, is_cut_by_depths_and_counted) {
    const Scene scene = walls({2});
    const ScenePose pose = pose_scene(scene, 0);
    const size_t all = size_t(extent.x) * extent.y;
    for (const auto& [near, far, before, beyond] :
         {std::tuple(1.9f, 9.0f, size_t(0), size_t(0)), {2.1f, 9.0f, all, size_t(0)}, {0.1f, 1.9f, size_t(0), all}}) {
        const SceneCamera camera = looking_ahead(near, far);
        EXPECT_EQ(seen(scene, camera).count(1), all - before - beyond);
        const PlaneCuts cuts = count_plane_cuts(scene, pose, pose_camera(camera, pose, 0), extent);
        EXPECT_EQ(cuts.before_near, before);
        EXPECT_EQ(cuts.beyond_far, beyond);
    }
}

/// The floor, tilted and mirrored things of the varied scene, where planes cut through them.
TEST(what_is_seen, is_cut_at_the_same_places) {
    Scene scene = varied_scene();
    for (const auto& [name, direction] :
         {std::pair("main", DepthDirection::standard), std::pair("orthographic", DepthDirection::reversed)}) {
        SceneCamera camera = scene.camera(name);
        camera.near = 4.9f, camera.far = 6.5f;
        const ScenePose pose = pose_scene(scene, 0);
        EXPECT_GT(count_plane_cuts(scene, pose, pose_camera(camera, pose, 0), extent).count(), 500u);
        expect_agreement(compare_with_rays(scene, camera, view_of(extent, 0, direction)), std::string(name) + ", cut");
    }
}

/// glTF 2.0, section 3.9.5. Looked at from behind, single-sided things are not there, mirrored ones as well (3.7.4).
TEST(what_is_seen, is_the_front_of_single_sided_surfaces) {
    Scene scene = varied_scene();
    scene.draws_backs = false;
    expect_agreement(compare_with_rays(scene, scene.camera("main"), view_of(extent)), "fronts");
    SceneCamera behind = scene.camera("main");
    behind.keys = {{0, {0, 1.6f, -12}, {0, 1, 3}}};
    const Agreement agreement = compare_with_rays(scene, behind, view_of(extent));
    expect_agreement(agreement, "backs");
    const Seen of_backs = seen(scene, behind);
    for (const unsigned hidden : {2u, 4u, 5u, 6u}) EXPECT_EQ(of_backs.count(hidden), 0u) << hidden;
    EXPECT_GT(of_backs.count(3), 100u);  // the double-sided one
    scene.draws_backs = true;
    const Seen of_all = seen(scene, behind);
    for (const unsigned shown : {2u, 3u, 4u, 5u, 6u}) EXPECT_GT(std::ranges::count(of_all.traced, shown), 20) << shown;
}

/// An instanced mesh, which Embree keeps in its own space: plain, mirrored and turned about.
TEST(what_is_seen, is_the_front_of_instances) {
    for (const float turn : {1.0f, -1.0f})
        for (const float mirror : {1.0f, -1.0f}) {
            Scene scene = walls({2});
            scene.draws_backs = false;
            scene.instances.push_back({0, 1});
            scene.nodes.push_back({.name = "elsewhere"});
            scene.nodes[1].parent_from_node[3] = {0, 0, 100, 1};
            scene.nodes[0].parent_from_node[0] *= mirror * turn;  // half a turn about y, or a mirror image in x
            scene.nodes[0].parent_from_node[2] *= turn;
            if (turn < 0) scene.nodes[0].parent_from_node[3] = {0, 0, -4, 1};
            const size_t all = size_t(extent.x) * extent.y;
            EXPECT_EQ(seen(scene, looking_ahead(0.1f, 10)).count(1), turn > 0 ? all : 0) << turn << ", " << mirror;
        }
}

/// The same of the next layers of depth.
TEST(what_is_seen, has_no_hidden_backs_in_its_layers) {
    Scene scene = walls({1, 2, 3});
    std::swap(scene.meshes[1].indices[0], scene.meshes[1].indices[1]);  // the wall at 2 m shows its back
    std::swap(scene.meshes[1].indices[3], scene.meshes[1].indices[4]);
    for (const bool draws_backs : {true, false}) {
        scene.draws_backs = draws_backs;
        Rasterizer rasterizer(test_device(), scene, {.extent = extent, .has_depth_layers = true});
        const GBuffer g = rasterizer.render(looking_ahead(0.5f, 10), view_of(extent));
        const CameraData& camera = rasterizer.camera();
        const auto depth = [&](const Image& image) {
            return view_distance(camera, *rasterizer.pass_list().download(image).pixel(extent.x / 2, extent.y / 2));
        };
        EXPECT_NEAR(depth(g.second_depth), draws_backs ? 2 : 3, 1e-4);
        EXPECT_NEAR(depth(g.back_depth), draws_backs ? 2 : 1, 1e-4);
    }
}

/// glTF 2.0, section 3.9.4: alpha that equals the cutoff is opaque, on a wall that runs from 1 m to 3 km: interpolation
/// in perspective rounds most there.
TEST(what_is_seen, has_no_holes_where_alpha_is_the_cutoff) {
    Scene scene = varied_scene();
    scene.animation.clear();
    scene.textures = {{.name = "even", .extent = {3, 5}, .rgba = make_texels(std::vector<uint8_t>(60, 100))}};
    scene.meshes = {quad(0, {-3, -1, -1}, {6, 0, -3000}, {0, 3, 0})};
    scene.instances = {{0, 0}};
    scene.nodes = {{.name = "wall"}};
    scene.materials = {{.name = "opaque"}};
    const SceneCamera camera = looking_ahead(0.1f, 5000);
    const Seen whole = seen(scene, camera);
    EXPECT_GT(std::ranges::count(whole.traced, 1u), 800);
    scene.materials[0].alpha_mode = AlphaMode::mask;
    for (const bool is_textured : {false, true})
        for (const float factor : {0.5f, 0.7f, 0.1f})
            for (const float color : {1.0f, 0.3f}) {
                SCOPED_TRACE(testing::Message() << factor << " x " << color << ", texture " << is_textured);
                scene.materials[0].base_color_texture.texture = is_textured ? 0 : -1;
                scene.materials[0].alpha = factor;
                for (Vertex& vertex : scene.meshes[0].vertices) vertex.color.a = color;
                // As a file's author would write it: rounded to float32 once.
                const double alpha = double(factor) * double(color) * (is_textured ? 100 / 255.0 : 1.0);
                scene.materials[0].alpha_cutoff = float(alpha);
                const Seen opaque = seen(scene, camera);
                EXPECT_TRUE(opaque.rasterised == whole.rasterised);
                EXPECT_TRUE(opaque.traced == whole.traced);
                scene.materials[0].alpha_cutoff = float(alpha * (1 + 1e-5));  // and no more than equal
                EXPECT_EQ(seen(scene, camera).count(1), 0u);
            }
}
