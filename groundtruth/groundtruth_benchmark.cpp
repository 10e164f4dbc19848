#include "core/error.h"
#include "core/scene/load_scene.h"
#include "groundtruth/path_tracer.h"

#include <benchmark/benchmark.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>

// How fast the path tracer is next to Embree alone: a render, then the very same rays replayed with rtcIntersect1 and
// rtcOccluded1 and nothing else, on the same cores, in the same order, and in the same run. `ratio` is the share of
// Embree's bare rate that remains with sampling and shading; 0.7 is the goal.

namespace {

constexpr unsigned width = 256, height = 256, tile = 16;

void add_quad(Scene& scene, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, unsigned material) {
    Mesh mesh{.name = "quad", .material = material};
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    for (const glm::vec3 corner : {a, b, c, d})
        mesh.vertices.push_back({corner, normal, {1, 0, 0, 1}, {}, glm::vec4(1.0f)});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.instances.push_back({unsigned(scene.meshes.size()), 0});
    scene.meshes.push_back(std::move(mesh));
}

void add_sphere(Scene& scene, glm::vec3 center, float radius, unsigned rings, unsigned material) {
    Mesh mesh{.name = "sphere", .material = material};
    for (unsigned j = 0; j <= rings; ++j)
        for (unsigned i = 0; i <= 2 * rings; ++i) {
            const float polar = float(M_PI) * float(j) / float(rings), azimuth = float(M_PI) * float(i) / float(rings);
            const glm::vec3 normal(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                   std::sin(polar) * std::sin(azimuth));
            mesh.vertices.push_back({center + radius * normal, normal, {1, 0, 0, 1}, {}, glm::vec4(1.0f)});
        }
    for (unsigned j = 0; j < rings; ++j)
        for (unsigned i = 0; i < 2 * rings; ++i) {
            const uint32_t a = j * (2 * rings + 1) + i, d = a + 2 * rings + 1;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, d + 1, a, d + 1, d});
        }
    scene.instances.push_back({unsigned(scene.meshes.size()), 0});
    scene.meshes.push_back(std::move(mesh));
}

/// A 2 m box with diffuse walls, a lamp in the ceiling, a GGX metal floor and a GGX metal ball: 9.2 thousand triangles.
Scene make_box() {
    Scene scene;
    scene.name = "box";
    const auto add = [&](glm::vec3 color, float metalness, float roughness, float emission) {
        Material material;
        material.base_color = color;
        material.metalness = metalness;
        material.roughness = roughness;
        material.emission = glm::vec3(emission);
        scene.materials.push_back(material);
        return unsigned(scene.materials.size() - 1);
    };
    const unsigned white = add(glm::vec3(.73f), 0, 1, 0), red = add({.65f, .05f, .05f}, 0, 1, 0),
                   green = add({.12f, .45f, .15f}, 0, 1, 0);
    const unsigned metal = add({.9f, .8f, .6f}, 1, .2f, 0), lamp = add(glm::vec3(0), 0, 1, 15);
    add_quad(scene, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, metal);
    add_quad(scene, {-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}, white);
    add_quad(scene, {-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, white);
    add_quad(scene, {-1, 0, 1}, {-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}, red);
    add_quad(scene, {1, 0, -1}, {1, 0, 1}, {1, 2, 1}, {1, 2, -1}, green);
    add_quad(scene, {-.25f, 1.998f, -.25f}, {.25f, 1.998f, -.25f}, {.25f, 1.998f, .25f}, {-.25f, 1.998f, .25f}, lamp);
    add_sphere(scene, {.4f, .4f, .2f}, .4f, 48, metal);
    scene.nodes.resize(1);
    return scene;
}

struct Setting {
    Scene scene;
    ScenePose pose;
    CameraPose camera;
};

Setting box_setting() {
    Setting setting{make_box(), {}, {}};
    setting.pose.world_from_instance.assign(setting.scene.instances.size(), glm::mat4(1.0f));
    setting.camera.world_from_view[3] = glm::vec4(0, 1, 3.6f, 1);
    setting.camera.vertical_fov = 0.66f;
    return setting;
}

Setting loaded_setting(const std::string& name) {
    Setting setting{load_scene(name, scene_search_path()), {}, {}};
    setting.pose = pose_scene(setting.scene, 0);
    setting.camera = pose_camera(setting.scene.camera(""), setting.pose, 0);
    return setting;
}

struct Tile {
    PixelEstimate estimate;
    std::vector<RecordedRay> rays;
};

/// Renders all tiles, on all cores; with `record`, takes down the rays.
std::vector<Tile> render(const PathTracer& tracer, unsigned samples, bool record) {
    std::vector<Tile> tiles((width / tile) * (height / tile));
    tbb::parallel_for(size_t(0), tiles.size(), [&](size_t index) {
        Tile& result = tiles[index];
        if (record) result.estimate.record = &result.rays;
        const unsigned x0 = unsigned(index) % (width / tile) * tile, y0 = unsigned(index) / (width / tile) * tile;
        for (unsigned y = y0; y < y0 + tile; ++y)
            for (unsigned x = x0; x < x0 + tile; ++x)
                tracer.trace(x, y, tracer.first_hit(x, y), 7, 0, samples, result.estimate);
    });
    return tiles;
}

template <class Work>
double seconds(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void compare_with_bare_embree(benchmark::State& state, const Setting& setting) {
    const unsigned samples = 64;
    const PathTracer tracer(setting.scene, setting.pose, setting.camera, {width, height}, {});
    const std::vector<Tile> recorded = render(tracer, samples, true);
    double rays = 0, paths = 0;
    for (const Tile& each : recorded) rays += double(each.estimate.rays), paths += double(each.estimate.paths);

    double render_seconds = 0, bare_seconds = 0;
    for (auto _ : state) {
        const double render_time = seconds([&] { benchmark::DoNotOptimize(render(tracer, samples, false)); });
        const double bare_time = seconds([&] {
            tbb::parallel_for(size_t(0), recorded.size(),
                              [&](size_t i) { benchmark::DoNotOptimize(tracer.replay(recorded[i].rays)); });
        });
        render_seconds += render_time;
        bare_seconds += bare_time;
        state.SetIterationTime(render_time);
    }
    const double count = double(state.iterations());
    state.counters["threads"] = tbb::this_task_arena::max_concurrency();
    state.counters["Mpaths/s"] = 1e-6 * count * paths / render_seconds;
    state.counters["Mrays/s"] = 1e-6 * count * rays / render_seconds;
    state.counters["bare_Mrays/s"] = 1e-6 * count * rays / bare_seconds;
    state.counters["rays/path"] = rays / paths;
    state.counters["ratio"] = bare_seconds / render_seconds;
}

}  // namespace

/// SSRLAB_BENCHMARK_SCENES: names of further scenes to measure, separated by commas.
int main(int argc, char** argv) try {
    benchmark::Initialize(&argc, argv);
    static std::vector<std::pair<std::string, Setting>> settings;
    settings.emplace_back("box", box_setting());
    if (const char* names = std::getenv("SSRLAB_BENCHMARK_SCENES")) {
        std::istringstream list(names);
        for (std::string name; std::getline(list, name, ',');) settings.emplace_back(name, loaded_setting(name));
    }
    for (const auto& [name, setting] : settings)
        benchmark::RegisterBenchmark(name.c_str(), compare_with_bare_embree, setting)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->MinTime(2);
    benchmark::RunSpecifiedBenchmarks();
} catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return 2;
}
