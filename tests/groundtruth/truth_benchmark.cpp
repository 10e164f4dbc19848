// What the path tracer gains by what it learns, and what a reference costs: variance of the specular light times rays,
// and times processor time, with each thing that is learnt over neither (`learning`), and the rays of a reference whose
// median pixel has an error of 3 % (`rays_to_3_percent`). `truth_benchmark --table` prints the first as two tables of
// groundtruth/measurements.md, and `--adaptive-table` what samples for the noisiest pixels gain. Scenes are found as by
// `ssrlab`; what is nowhere is left out with a note.
#include "core/error.h"
#include "core/scene/load_scene.h"
#include "groundtruth/paths/path_tracer.h"
#include "groundtruth/reference/reference.h"
#include "groundtruth/reference/reference_error.h"
#include "metrics/statistics/quantiles.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <optional>

namespace {

constexpr const char* scene_names[] = {
    "modern_hall", "breakfast_room", "sponza",         "room:3",         "room:11",
    "street:2",    "flight_helmet",  "facing_mirrors", "glossy_stretch", "emissive_strength_test"};
constexpr const char* rooms[] = {"modern_hall", "breakfast_room", "sponza"};
constexpr glm::uvec2 extent(48, 27);
constexpr unsigned batches = 8, samples = 16, guide_samples = 64, few_guide_samples = 16, seeds = 8;
/// A pixel darker than this share of the mean counts as if it were so bright: else a few black ones would decide.
constexpr double floor_share = 0.1;

struct Learnt {
    const char *name, *title;
    bool lights, clusters = false, roulette = false, splitting = false, shadow_rays = false, mirrored_lamps = false,
                 has_few_guide_samples = false;
};
constexpr Learnt neither{"neither", "neither", false};
constexpr Learnt learnt[] = {
    {"roulette", "roulette alone", false, false, true},
    {"lights", "lights", true},
    {"clusters", "and clusters", true, true},
    {"both", "and roulette", true, true, true},
    {"splitting", "and splitting", true, true, true, true},
    {"shadow_rays", "and shadow rays", true, true, true, true, true},
    {"all", "and mirrored lamps", true, true, true, true, true, true},
    {"all_few_guide_samples", "all, guide of 16 samples", true, true, true, true, true, true, true}};

struct Spent {
    double variance = 0, rays = 0, cpu_seconds = 0;  ///< the first: mean over pixels, relative to their radiance
};

double luminance_of(glm::dvec3 rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

double cpu_seconds() {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// A scene's first view, with about what each pixel holds.
class View {
public:
    explicit View(Scene scene)
        : scene_(std::move(scene)),
          pose_(pose_scene(scene_, 0)),
          camera_(pose_camera(scene_.cameras.front(), pose_, 0)) {
        const PathTracer tracer(scene_, pose_, camera_, extent, {});
        guide_ = guide(tracer, guide_samples), few_samples_guide_ = guide(tracer, few_guide_samples);
        for (size_t pixel = 0; pixel < guide_.specular.pixel_count(); ++pixel)
            if (tracer.first_hit(unsigned(pixel % extent.x), unsigned(pixel / extent.x)).is_hit)
                mean_ += luminance_of(guide_.specular.rgb(pixel)), ++hits_;
        mean_ /= std::max(hits_, 1.0);
    }

    /// By seeds, whose paths are others.
    std::vector<Spent> spent(const Learnt& what) const {
        PathTracer tracer(scene_, pose_, camera_, extent,
                          {.splitting = what.splitting,
                           .shadow_roulette = what.shadow_rays,
                           .learns_lights = what.lights,
                           .light_clusters = what.clusters,
                           .mirrored_lamps = what.mirrored_lamps});
        const Guide& guide = what.has_few_guide_samples ? few_samples_guide_ : guide_;
        if (what.roulette) tracer.expect(guide.diffuse, guide.specular);
        std::vector<Spent> of_seeds(seeds);
        for (unsigned seed = 0; seed < seeds; ++seed) of_seeds[seed] = spent(tracer, 1000 * (seed + 1));
        return of_seeds;
    }

private:
    struct Guide {
        HostImage diffuse{extent, 3}, specular{extent, 3};
    };

    static Guide guide(const PathTracer& tracer, unsigned count) {
        Guide guide;
        for (size_t pixel = 0; pixel < guide.specular.pixel_count(); ++pixel) {
            PixelEstimate sum;
            trace(tracer, pixel, 1, count, sum);
            guide.diffuse.set_rgb(pixel, glm::vec3(sum.diffuse / double(count)));
            guide.specular.set_rgb(pixel, glm::vec3(sum.specular / double(count)));
        }
        return guide;
    }

    static FirstHit trace(const PathTracer& tracer, size_t pixel, uint64_t seed, unsigned count, PixelEstimate& sum) {
        const unsigned x = unsigned(pixel % extent.x), y = unsigned(pixel / extent.x);
        const FirstHit hit = tracer.first_hit(x, y);
        if (hit.is_hit && !hit.is_unlit) tracer.trace(x, y, hit, seed, 0, count, sum);
        return hit;
    }

    Spent spent(const PathTracer& tracer, uint64_t seed) const {
        Spent all;
        const double start = cpu_seconds();
        for (size_t pixel = 0; pixel < guide_.specular.pixel_count(); ++pixel) {
            double sum = 0, squares = 0;
            bool is_hit = true;
            for (unsigned batch = 0; batch < batches && is_hit; ++batch) {
                PixelEstimate estimate;
                is_hit = trace(tracer, pixel, seed + batch, samples, estimate).is_hit;
                const double value = luminance_of(estimate.specular) / samples;
                sum += value, squares += value * value, all.rays += double(estimate.rays);
            }
            const double radiance = std::max(luminance_of(guide_.specular.rgb(pixel)), floor_share * mean_);
            const double variance = std::max(squares - sum * sum / batches, 0.0) / (batches - 1);
            if (is_hit && radiance > 0) all.variance += variance / (radiance * radiance) / hits_;
        }
        all.cpu_seconds = cpu_seconds() - start;
        return all;
    }

    Scene scene_;
    ScenePose pose_;
    CameraPose camera_;
    Guide guide_, few_samples_guide_;
    double mean_ = 0, hits_ = 0;
};

struct Ratio {
    double value = 1, low = 1, high = 1;
};

/// Geometric mean over the seeds with its 95 % interval (Student's t of the logarithms).
template <class Spent, class Cost>
Ratio ratio_of(const std::vector<Spent>& with, const std::vector<Spent>& without, Cost cost) {
    double sum = 0, squares = 0;
    for (unsigned i = 0; i < seeds; ++i) {
        const double log = std::log(cost(with[i]) / cost(without[i]));
        sum += log, squares += log * log;
    }
    const double mean = sum / seeds, deviation = std::sqrt(std::max(squares - sum * mean, 0.0) / (seeds - 1));
    const double half = student_t_quantile(0.975, seeds - 1) * deviation / std::sqrt(double(seeds));
    return {std::exp(mean), std::exp(mean - half), std::exp(mean + half)};
}

double by_rays(const Spent& s) { return s.variance * s.rays; }
double by_cpu(const Spent& s) { return s.variance * s.cpu_seconds; }

/// None where the scene is not on this machine.
std::optional<Scene> scene_of(const std::string& name) {
    try {
        return load_scene(name, scene_search_path());
    } catch (const Error& error) {
        std::fprintf(stderr, "%s is left out: %s\n", name.c_str(), error.what());
        return {};
    }
}

std::optional<View> view_of(const std::string& name) {
    std::optional<Scene> scene = scene_of(name);
    return scene ? std::optional<View>(std::in_place, std::move(*scene)) : std::nullopt;
}

void measure_learning(benchmark::State& state, const std::string& scene, const Learnt& what) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const std::optional<View> view = view_of(scene);
    if (!view) return state.SkipWithError("the scene is not on this machine");
    for (auto _ : state) {
        const std::vector<Spent> with = view->spent(what), without = view->spent(neither);
        const Ratio rays = ratio_of(with, without, by_rays), cpu = ratio_of(with, without, by_cpu);
        state.counters["rays"] = rays.value, state.counters["rays_low"] = rays.low,
        state.counters["rays_high"] = rays.high;
        state.counters["cpu"] = cpu.value, state.counters["cpu_low"] = cpu.low, state.counters["cpu_high"] = cpu.high;
    }
}

/// Mean of the squared relative errors: what a few pixels decide, and no median sees.
double mean_square_error(const Reference& r) {
    const HostImage error = relative_error(r, r.specular);
    double sum = 0, count = 0;
    for (size_t i = 0; i < error.values.size(); ++i)
        if (r.material_id.values[i] != 0) sum += std::pow(double(error.values[i]), 2), ++count;
    return sum / count;
}

/// From 256 samples, errors falling with the square root of the rays: at 192x108, without the guide's, and with a
/// budget of the lit colour of its own, which the specular light does not wait for. Rays until the median of the pixels
/// is wanted, and until the root of the mean square is; of each the median of three seeds.
void measure_rays(benchmark::State& state, const std::string& name) {
    constexpr double wanted = 0.03;
    const std::optional<Scene> scene = scene_of(name);
    if (!scene) return state.SkipWithError("the scene is not on this machine");
    const ScenePose pose = pose_scene(*scene, 0);
    const CameraPose camera = pose_camera(scene->cameras.front(), pose, 0);
    for (auto _ : state) {
        std::vector<double> needed, needed_of_mean;
        double rays = 0, seconds = 0;
        for (unsigned seed = 1; seed <= 3; ++seed) {
            const Reference r = render_reference(*scene, pose, camera, {192, 108},
                                                 {.max_samples = 256, .lit_samples = 16, .seed = seed});
            needed.push_back(r.rays * std::pow(relative_error_summary(r, r.specular).median / wanted, 2));
            needed_of_mean.push_back(r.rays * mean_square_error(r) / (wanted * wanted));
            rays += r.rays, seconds += r.seconds;
        }
        std::ranges::sort(needed), std::ranges::sort(needed_of_mean);
        state.counters["rays_to_3_percent"] = needed[1];
        state.counters["least"] = needed[0], state.counters["most"] = needed[2];
        state.counters["mean_square"] = needed_of_mean[1], state.counters["mean_square_least"] = needed_of_mean[0],
        state.counters["mean_square_most"] = needed_of_mean[2];
        state.counters["rays_per_second"] = rays / seconds;
    }
}

std::string text_of(const Ratio& ratio) {
    char text[64];
    std::snprintf(text, sizeof text, "%.2f [%.2f, %.2f]", ratio.value, ratio.low, ratio.high);
    return text;
}

/// Variances of pixels, of their radiance and relative to it, and what they cost.
struct Noise {
    double absolute = 0, relative = 0, rays = 0;
};

Noise noise_of(const Reference& r, bool of_image) {
    Noise noise{.rays = r.rays};
    const ReferenceOutput& output = of_image ? r.image : r.specular;
    const double least = floor_share / relative_error_floor * radiance_floor(r, output);
    for (size_t i = 0; i < output.mean.pixel_count(); ++i) {
        const glm::dvec3 variance = output.variance.rgb(i);
        const double sum = variance.x + variance.y + variance.z;
        glm::dvec3 radiance(r.guide.specular.rgb(i));
        if (of_image) radiance += glm::dvec3(r.guide.diffuse.rgb(i) + r.highlights.rgb(i));
        noise.absolute += sum;
        noise.relative += sum / std::pow(std::max(luminance_of(radiance), least), 2);
    }
    return noise;
}

/// Noise times rays with an adaptive share over the same without one: for the specular light as studies of rooms judge
/// it, and for the image.
int print_adaptive_table() {
    std::printf(
        "| Scene | specular: noise of `mse` | of `relmse` | rays | image: noise of `mse` | of `relmse` | rays |\n");
    std::printf("|---|---|---|---|---|---|---|\n");
    constexpr const char* more_rooms[] = {"room:10001", "room:10007", "street:10004"};
    std::vector<const char*> names(std::begin(scene_names), std::end(scene_names));
    names.insert(names.end(), std::begin(more_rooms), std::end(more_rooms));
    for (const char* name : names) {
        const std::optional<Scene> scene = scene_of(name);
        if (!scene) continue;
        const ScenePose pose = pose_scene(*scene, 0);
        const CameraPose camera = pose_camera(scene->cameras.front(), pose, 0);
        const auto noises = [&](bool of_image, float share) {
            std::vector<Noise> of_seeds;
            for (unsigned seed = 1; seed <= seeds; ++seed)
                of_seeds.push_back(noise_of(render_reference(*scene, pose, camera, {96, 54},
                                                             {.max_samples = 128,
                                                              .lit_samples = of_image ? 0u : 32u,
                                                              .adaptive_share = share,
                                                              .adaptive_image = of_image,
                                                              .seed = seed,
                                                              .guide_samples = few_guide_samples}),
                                            of_image));
            return of_seeds;
        };
        std::printf("| `%s` |", name);
        for (const bool of_image : {false, true}) {
            const std::vector<Noise> with = noises(of_image, of_image ? 1.0f : 0.25f), without = noises(of_image, 0);
            std::printf(" %s | %s | %s |",
                        text_of(ratio_of(with, without, [](const Noise& n) { return n.absolute * n.rays; })).c_str(),
                        text_of(ratio_of(with, without, [](const Noise& n) { return n.relative * n.rays; })).c_str(),
                        text_of(ratio_of(with, without, [](const Noise& n) { return n.rays; })).c_str());
            std::fflush(stdout);
        }
        std::printf("\n");
    }
    return 0;
}

/// Both products of every scene: a table of the rays while it is measured, then one of the times.
int print_table() {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const auto print_head = [] {
        std::printf("| Scene |");
        for (const Learnt& what : learnt) std::printf(" %s |", what.title);
        std::printf("\n|---|");
        for (size_t i = 0; i < std::size(learnt); ++i) std::printf("---|");
        std::printf("\n");
    };
    std::string times;
    print_head();
    for (const char* name : scene_names) {
        const std::optional<View> view = view_of(name);
        if (!view) continue;
        std::printf("| `%s` |", name);
        times += std::string("| `") + name + "` |";
        const std::vector<Spent> without = view->spent(neither);
        for (const Learnt& what : learnt) {
            const std::vector<Spent> with = view->spent(what);
            std::printf(" %s |", text_of(ratio_of(with, without, by_rays)).c_str());
            times += " " + text_of(ratio_of(with, without, by_cpu)) + " |";
            std::fflush(stdout);
        }
        std::printf("\n"), times += "\n";
    }
    std::printf("\n");
    print_head();
    std::printf("%s", times.c_str());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::strcmp(argv[1], "--table") == 0) return print_table();
    if (argc == 2 && std::strcmp(argv[1], "--adaptive-table") == 0) return print_adaptive_table();
    for (const char* scene : scene_names)
        for (const Learnt& what : learnt)
            benchmark::RegisterBenchmark((std::string("learning/") + scene + "/" + what.name).c_str(), measure_learning,
                                         std::string(scene), what)
                ->Iterations(1)
                ->Unit(benchmark::kSecond);
    for (const char* scene : rooms)
        benchmark::RegisterBenchmark((std::string("rays_to_3_percent/") + scene).c_str(), measure_rays,
                                     std::string(scene))
            ->Iterations(1)
            ->Unit(benchmark::kSecond);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
