#include "core/gpu/device.h"
#include "core/scene/camera.h"
#include "variants/amd_sssr/passes.h"
#include "variants/amd_sssr/tracing_parameters.h"

#include <benchmark/benchmark.h>
#include <cmath>
#include <ctime>
#include <map>

// The denoiser's passes in both forms, side by side: a glossy floor in eight strips of roughness before a checkered
// wall, seen by a camera that moves sideways. Times are those of the pass graph (ms per frame, submission included);
// cpu_ms is the time of all processors, which other programs disturb less. Run with
// --benchmark_enable_random_interleaving=true --benchmark_repetitions=9 and compare the medians.

namespace {

constexpr float wall_z = -6.0f, eye_height = 1.6f, step_per_frame = 0.04f;  // m

CameraPose pose_of(unsigned frame) {
    CameraPose pose;
    pose.vertical_fov = 1.047f;
    pose.world_from_view[3] = {step_per_frame * float(frame), eye_height, 4.0f, 1.0f};
    return pose;
}

float floor_alpha(float x) {
    constexpr float strips[8] = {0.0f, 0.0025f, 0.01f, 0.032f, 0.0625f, 0.12f, 0.185f, 0.36f};
    return strips[int(std::clamp(x + 4.0f, 0.0f, 7.0f))];
}

/// In [0, 1), by the finalizer of MurmurHash3.
float random_number(uint32_t x, uint32_t y, uint32_t frame) {
    uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ frame * 0xc2b2ae3du;
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return float((h ^ h >> 16) >> 8) / 16777216.0f;
}

glm::vec3 wall_color(float x, float y) {
    const bool is_bright = (int(std::floor(x)) + int(std::floor(y))) & 1;
    return is_bright ? glm::vec3(1.5f, 1.2f, 0.7f) : glm::vec3(0.1f, 0.2f, 0.4f);
}

/// One frame's images on the CPU.
struct Frame {
    CameraData camera;
    HostImage depth, normal, motion, radiance, roughness;
    std::vector<uint32_t> tiles;
};

void fill_pixel(Frame& frame, const CameraPose& pose, glm::uvec2 extent, unsigned x, unsigned y, unsigned index) {
    const CameraRay ray = camera_ray(pose, extent, glm::vec2(x, y) + 0.5f);
    const bool is_floor = ray.direction.y < 0 && ray.direction.z / ray.direction.y < (wall_z - 4.0f) / -eye_height;
    const float distance = is_floor ? -eye_height / ray.direction.y : (wall_z - ray.origin.z) / ray.direction.z;
    const glm::vec3 point = ray.origin + distance * ray.direction;
    const float alpha = is_floor ? floor_alpha(point.x) : 0.8f;
    const glm::vec3 mirrored(ray.direction.x, -ray.direction.y, ray.direction.z);
    const float reflected = is_floor ? (wall_z - point.z) / mirrored.z : 0.0f;
    const glm::vec3 seen = point + reflected * mirrored;
    const float spread = 8.0f * alpha * (random_number(x, y, index) - 0.5f);
    const glm::vec3 color = is_floor ? wall_color(seen.x + spread, seen.y) : glm::vec3(0.2f);

    const glm::vec4 clip = frame.camera.clip_from_world * glm::vec4(point, 1.0f);
    const glm::vec4 before = frame.camera.previous_clip_from_world * glm::vec4(point, 1.0f);
    const glm::vec2 motion = 0.5f * (glm::vec2(clip) / clip.w - glm::vec2(before) / before.w);
    *frame.depth.pixel(x, y) = clip.z / clip.w;
    *frame.roughness.pixel(x, y) = alpha;
    frame.normal.pixel(x, y)[is_floor ? 1 : 2] = 1.0f;
    for (int c = 0; c < 2; ++c) frame.motion.pixel(x, y)[c] = motion[c];
    for (int c = 0; c < 3; ++c) frame.radiance.pixel(x, y)[c] = color[c];
    frame.radiance.pixel(x, y)[3] = reflected;
}

Frame make_frame(glm::uvec2 extent, unsigned index, unsigned previous) {
    const CameraPose pose = pose_of(index), before = pose_of(previous);
    Frame frame{.camera = camera_data(pose, &before, {.extent = extent, .frame = index}),
                .depth{extent, 1},
                .normal{extent, 4},
                .motion{extent, 2},
                .radiance{extent, 4},
                .roughness{extent, 1},
                .tiles{}};
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) fill_pixel(frame, pose, extent, x, y, index);
    for (unsigned y = 0; y < extent.y; y += 8)
        for (unsigned x = 0; x < extent.x; x += 8)
            if (*frame.roughness.pixel(x, std::min(y + 7, extent.y - 1)) < 0.2f) frame.tiles.push_back(y << 16 | x);
    return frame;
}

/// Six frames, of which each follows the one before and the first the last: there the camera jumps back.
const std::vector<Frame>& frames_of(glm::uvec2 extent) {
    static std::map<unsigned, std::vector<Frame>> made;
    std::vector<Frame>& frames = made[extent.x];
    for (unsigned i = 0; frames.size() < 6; ++i) frames.push_back(make_frame(extent, i, (i + 5) % 6));
    return frames;
}

struct Bench {
    PassGraph graph;
    ParameterSet params;
    TracingParameters tracing{params};
    DenoiserParameters denoiser{params};
    AmdWork work;
    double cpu_ms = 0;  ///< of all frames so far, on a CPU device

    Bench(Device& device, glm::uvec2 extent, const char* form) : graph(device, extent) {
        params.assign({{"denoiser_form", form}, {"barrier_before_average", true}});
        work.tile_list = graph.buffer("tiles", size_t(extent.x / 8) * (extent.y / 8) * 4);
        work.counters = graph.buffer("counters", 16);
        work.indirect_arguments = graph.buffer("arguments", 36);
    }

    /// Uploads the frame; only the denoiser's passes are timed.
    std::vector<PassTime> run(const Frame& frame, const Frame& before) {
        const auto upload = [&](const char* name, Format format, const HostImage& pixels) {
            const Image image = graph.image(name, format);
            graph.upload(image, pixels);
            return image;
        };
        GBuffer gbuffer;
        gbuffer.depth = upload("depth", Format::r32f, frame.depth);
        gbuffer.normal = upload("normal", Format::rgba32f, frame.normal);
        gbuffer.motion = upload("motion", Format::rg32f, frame.motion);
        gbuffer.previous_depth = upload("previous_depth", Format::r32f, before.depth);
        gbuffer.previous_normal = upload("previous_normal", Format::rgba32f, before.normal);
        graph.begin_frame(frame.camera, params, std::vector{gbuffer.depth, gbuffer.normal, gbuffer.motion});
        const AmdHistories histories = amd_histories(graph, denoiser.float_histories, false);
        graph.upload(histories.radiance.current, frame.radiance);
        graph.upload(histories.roughness.current, frame.roughness);
        graph.upload(work.tile_list, std::as_bytes(std::span(frame.tiles)));
        const uint32_t count = uint32_t(frame.tiles.size());
        const uint32_t arguments[9] = {0, 0, 1, count, 1, 1, (count + 7) / 8, 1, 1}, counters[4] = {0, 0, 0, count};
        graph.upload(work.counters, std::as_bytes(std::span(counters)));
        graph.upload(work.indirect_arguments, std::as_bytes(std::span(arguments)));
        const std::clock_t start = std::clock();
        amd_denoise(graph, gbuffer, work, histories, denoiser);
        cpu_ms += 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC;
        return graph.times();
    }
};

void denoise(benchmark::State& state, const char* form) {
    static Device device;
    const glm::uvec2 extent(state.range(0), state.range(1));
    const std::vector<Frame>& frames = frames_of(extent);
    Bench bench(device, extent, form);
    const auto at = [&](size_t i) -> const Frame& { return frames[i % frames.size()]; };
    for (size_t i = 0; i < 3; ++i) bench.run(at(i + 1), at(i));  // compiles the shaders and fills the histories
    std::map<std::string, double> sums;
    bench.cpu_ms = 0;
    size_t index = 3;
    for (auto _ : state) {
        double total = 0;
        for (const PassTime& pass : bench.run(at(index + 1), at(index))) {
            if (!pass.stage.starts_with("amd_sssr/")) continue;
            sums[pass.stage.substr(9)] += pass.milliseconds;
            total += pass.milliseconds;
        }
        state.SetIterationTime(total * 1e-3);
        ++index;
    }
    for (const auto& [stage, sum] : sums)
        state.counters[stage + "_ms"] = benchmark::Counter(sum, benchmark::Counter::kAvgIterations);
    state.counters["cpu_ms"] = benchmark::Counter(bench.cpu_ms, benchmark::Counter::kAvgIterations);
    state.counters["tiles"] = double(frames[0].tiles.size());
}

}  // namespace

BENCHMARK_CAPTURE(denoise, faithful, "faithful")
    ->Args({640, 384})
    ->Args({1280, 704})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(denoise, fast, "fast")
    ->Args({640, 384})
    ->Args({1280, 704})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
