#include "core/gpu/device.h"
#include "tests/variants/synthetic_gbuffer.h"
#include "variants/registry.h"
#include "variants/tracers/tracers.h"

#include <benchmark/benchmark.h>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>

// Whole frames of the stochastic techniques, and their stages, on one G-buffer: a floor of metal in strips of growing
// roughness, all of which both trace, before a checkered wall, seen by a camera at rest. Times are those of the pass
// pass_list (ms per frame, submissions included); cpu_ms is the time of all processors, which other programs disturb
// less. Run with --benchmark_enable_random_interleaving=true --benchmark_repetitions=9 and compare the medians.

namespace {

SyntheticHit strips_before_wall(const CameraRay& ray) {
    const float to_wall = (-6.0f - ray.origin.z) / ray.direction.z;
    const float to_floor =
        ray.direction.y < 0.0f ? (-1.0f - ray.origin.y) / ray.direction.y : std::numeric_limits<float>::infinity();
    const glm::vec3 hit = ray.origin + std::min(to_wall, to_floor) * ray.direction;
    if (to_floor < to_wall) {
        const float strip = std::clamp(std::floor(hit.x + 4.0f), 0.0f, 7.0f);
        return {.distance = to_floor, .normal = {0, 1, 0}, .roughness = 0.055f * strip, .metalness = 1, .specular = 1};
    }
    const bool is_bright = int(std::floor(2.0f * hit.x) + std::floor(2.0f * hit.y)) % 2 == 0;
    return {.distance = to_wall, .normal = {0, 0, 1}, .lit = glm::vec3(is_bright ? 1.0f : 0.1f)};
}

/// One frame after `index` others.
std::vector<PassTime> run(PassList& pass_list, Technique& technique, const GBuffer& gbuffer, CameraData camera,
                          unsigned index) {
    camera.frame = {index, 0, 0, index > 0 ? 1 : 0};
    pass_list.begin_frame(camera, technique.params, gbuffer.images());
    const LimitScope limits(pass_list, technique.limits);
    technique.render(pass_list, gbuffer);
    return pass_list.times();
}

void frames(benchmark::State& state, const char* name, const char* preset, const nlohmann::json& parameters) {
    static Device device;
    const glm::uvec2 extent(state.range(0), state.range(1));
    PassList pass_list(device, extent);
    const CameraPose pose;
    const CameraData camera = camera_data(pose, nullptr, {.extent = extent});
    const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, strips_before_wall);
    const std::unique_ptr<Technique> technique = make_technique(name, parameters, preset);

    unsigned index = 0;
    while (index < 8)
        run(pass_list, *technique, gbuffer, camera, index++);  // compiles the shaders, fills the histories
    std::map<std::string, double> sums;
    double cpu_ms = 0;
    for (auto _ : state) {
        const std::clock_t start = std::clock();
        const std::vector<PassTime> stages = run(pass_list, *technique, gbuffer, camera, index++);
        cpu_ms += 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC;
        double total = 0;
        for (const PassTime& stage : stages) {
            sums[stage.stage] += stage.milliseconds;
            total += stage.milliseconds;
        }
        state.SetIterationTime(total * 1e-3);
    }
    for (const auto& [stage, sum] : sums)
        state.counters[stage + "_ms"] = benchmark::Counter(sum, benchmark::Counter::kAvgIterations);
    state.counters["cpu_ms"] = benchmark::Counter(cpu_ms, benchmark::Counter::kAvgIterations);
}

/// AMD's march alone: rays and texels of depth per second of its pass, and texels per ray.
void march(benchmark::State& state, const char* preset, const nlohmann::json& parameters) {
    static Device device;
    const glm::uvec2 extent(state.range(0), state.range(1));
    const CameraPose pose;
    const CameraData camera = camera_data(pose, nullptr, {.extent = extent});
    PassList pass_list(device, extent), counting_graph(device, extent);
    const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, strips_before_wall);
    const std::unique_ptr<Technique> technique = make_technique("amd_sssr", parameters, preset);
    const std::unique_ptr<Technique> counting = make_technique("amd_sssr", parameters, preset);
    RayProbe probe;
    probe.is_recording = true;
    counting->ray_probe = &probe;

    double rays = 0, texels = 0, seconds = 0;
    unsigned index = 0;
    for (auto _ : state) {
        double milliseconds = 0;
        for (const PassTime& stage : run(pass_list, *technique, gbuffer, camera, index))
            if (stage.stage == "amd_sssr/intersect") milliseconds += stage.milliseconds;
        state.SetIterationTime(milliseconds * 1e-3);
        seconds += milliseconds * 1e-3;
        // The same frame with the same histories sends the same rays.
        probe.recorded.clear();
        run(counting_graph, *counting, upload_gbuffer(counting_graph, pose, camera, strips_before_wall), camera,
            index++);
        for (const RayRecord& ray : probe.recorded.at(0).rays) {
            rays += double(ray.is_traced);
            texels += ray.fetches;
        }
    }
    state.counters["rays_per_s"] = rays / seconds;
    state.counters["texels_per_s"] = texels / seconds;
    state.counters["texels_per_ray"] = texels / rays;
}

void at_both_sizes(benchmark::internal::Benchmark* registered) {
    registered->Args({640, 384})->Args({1920, 1080})->UseManualTime()->Unit(benchmark::kMillisecond);
}

// AMD's default threshold, alpha < 0.2.
const nlohmann::json full = {{"roughness_threshold", 0.447}},
                     views = {{"roughness_threshold", 0.447}, {"hierarchy", "mip_views"}},
                     half = {{"roughness_threshold", 0.447}, {"half_resolution", true}},
                     quarter = {{"guided_tracing", false}}, coarser = {{"hierarchy.most_detailed_mip", 1}},
                     as_is = nlohmann::json::object();

}  // namespace

BENCHMARK_CAPTURE(frames, amd_repeatable, "amd_sssr", "repeatable", as_is)->Apply(at_both_sizes);
BENCHMARK_CAPTURE(march, amd_repeatable, "repeatable", as_is)->Apply(at_both_sizes);
BENCHMARK_CAPTURE(march, amd_quarter_rate, "repeatable", quarter)->Apply(at_both_sizes);
BENCHMARK_CAPTURE(march, amd_from_mip_1, "repeatable", coarser)->Apply(at_both_sizes);
BENCHMARK_CAPTURE(march, amd_corrected, "corrected", as_is)->Apply(at_both_sizes);
BENCHMARK_CAPTURE(frames, diligent_april_2024, "diligent_ssr", "april_2024", full)->Apply(at_both_sizes);
BENCHMARK_CAPTURE(frames, diligent_current, "diligent_ssr", "current", full)->Apply(at_both_sizes);
BENCHMARK_CAPTURE(frames, diligent_current_mip_views, "diligent_ssr", "current", views)->Apply(at_both_sizes);
BENCHMARK_CAPTURE(frames, diligent_current_half, "diligent_ssr", "current", half)->Apply(at_both_sizes);
BENCHMARK_CAPTURE(frames, diligent_corrected, "diligent_ssr", "corrected", full)->Apply(at_both_sizes);

// One mirror ray per pixel by each tracer that the made-up G-buffer has all for.
int main(int argc, char** argv) {
    for (const TracerEntry& tracer : tracer_table())
        if (tracer.name != "exact_scene") {
            const nlohmann::json parameters = {{"tracer", tracer.name}, {"exact_layer.thickness_from", "parameter"}};
            at_both_sizes(benchmark::RegisterBenchmark(
                ("tracers/" + tracer.name).c_str(),
                [=](benchmark::State& state) { frames(state, "mcguire_dda", "", parameters); }));
        }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
