#include "experiments/study/estimate.h"

#include "experiments/measuring/render_variant.h"
#include "experiments/study/point_run.h"
#include "experiments/study/shot_run.h"
#include "groundtruth/reference.h"
#include "variants/registry.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <set>

namespace fs = std::filesystem;

namespace {

constexpr std::array<glm::uvec2, 2> calibration_extents = {glm::uvec2(64, 36), glm::uvec2(160, 90)};
constexpr unsigned calibration_samples = 32;
constexpr double clock_proof_seconds = 5, compiling_seconds = 0.3, counting_factor = 5;

double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double pixels_of(glm::uvec2 extent) { return double(extent.x) * double(extent.y); }

/// Seconds that grow with the number of pixels.
struct Line {
    double fixed = 0, per_pixel = 0;
    double at(double pixels) const { return fixed + per_pixel * pixels; }
};

Line line_through(const std::array<double, 2>& seconds) {
    const double few = pixels_of(calibration_extents[0]), many = pixels_of(calibration_extents[1]);
    const double slope = std::max(seconds[1] - seconds[0], 0.0) / (many - few);
    return {std::max(seconds[0] - slope * few, 0.0), slope};
}

/// What was measured on small images.
struct Rates {
    Line opening;           ///< a shot: its scene, its first frame, what is measured of the truth
    double per_sample = 0;  ///< seconds per pixel and sample of a reference
    std::map<std::string, Line> per_step, per_frame;  ///< by kind_of(): a frame of a seed, measured; a frame, timed
};

/// Points that take about equally long.
std::string kind_of(const VariantConfig& variant) { return variant.variant + " " + variant.preset; }

/// Measures on a folder of its own, which it removes.
class Calibration {
public:
    Calibration(Device& device, const Config& config, const RunSettings& settings)
        : device_(device), settings_(settings), config_(config) {
        folder_ = fs::temp_directory_path() / ("ssrlab-plan-" + std::to_string(getpid()));
        std::set<std::string> kinds;
        std::vector<VariantConfig> one_of_each;
        for (VariantConfig variant : config.variants)
            if (kinds.insert(kind_of(variant)).second) {
                variant.seeds = {variant.seeds.front()};
                one_of_each.push_back(std::move(variant));
            }
        config_.variants = std::move(one_of_each);
        config_.reference = {.max_samples = calibration_samples, .max_depth = config.reference.max_depth};
    }
    ~Calibration() {
        std::error_code error;
        fs::remove_all(folder_, error);
    }

    Rates measure(const ShotConfig& shot) {
        std::array<double, 2> opening{}, traced{};
        std::map<std::string, std::array<double, 2>> step, frame;
        for (size_t i = 0; i < calibration_extents.size(); ++i) {
            const std::unique_ptr<ShotRun> run = open(shot, i, opening[i], traced[i]);
            measure_steps(*run, i, step);
            measure_frames(*run, i, frame);
        }
        Rates rates{.opening = line_through(opening),
                    .per_sample = line_through(traced).per_pixel / calibration_samples,
                    .per_step = {},
                    .per_frame = {}};
        for (const auto& [kind, seconds] : step) rates.per_step[kind] = line_through(seconds);
        for (const auto& [kind, seconds] : frame) rates.per_frame[kind] = line_through(seconds);
        return rates;
    }

private:
    /// A still frame of the shot; of a capture its own size.
    std::unique_ptr<ShotRun> open(const ShotConfig& shot, size_t size, double& opening, double& traced) {
        ShotConfig small = shot;
        small.extent = calibration_extents[size], small.frames = {shot.frames.front()};
        small.warm_up = 0, small.repeat = 1, small.measure_from = shot.frames.front();
        small.change.reset();
        std::unique_ptr<ShotRun> run;
        const double all = seconds_of([&] {
            run = open_shot(device_, small, config_,
                            {.out = folder_,
                             .cache = folder_ / ("cache" + std::to_string(size)),
                             .search_path = settings_.search_path,
                             .keep_all = settings_.keep_all,
                             .say = [](const std::string&) {},
                             .report = [](double, const std::string&) {}});
        });
        traced = run->entry.contains("reference") ? run->entry["reference"]["seconds"].get<double>() : 0.0;
        opening = std::max(all - traced, 0.0);
        return run;
    }

    void measure_steps(ShotRun& run, size_t size, std::map<std::string, std::array<double, 2>>& seconds) {
        for (const VariantConfig& variant : config_.variants) {
            const auto play = [&] {
                run_point(
                    device_, run.shot, run.truth, *run.store, config_, variant,
                    {.out = folder_, .image_suffix = "plan", .keep_all = settings_.keep_all, .report = [](double) {}});
            };
            if (size == 0) play();  // compiles
            seconds[kind_of(variant)][size] = seconds_of(play);
        }
    }

    void measure_frames(ShotRun& run, size_t size, std::map<std::string, std::array<double, 2>>& seconds) {
        const FrameStep& step = run.shot.steps.front();
        const FrameStore::Frame frame = run.store->frame(step, run.truth.lit(step));
        for (const VariantConfig& config : config_.variants) {
            if (!config.is_timed) continue;
            PassGraph graph(device_, run.shot.config.extent);
            const std::unique_ptr<Variant> variant = make_variant(config.variant, config.parameters, config.preset);
            if (!settings_.keep_all) variant->leave_out(run.shot.facts);
            const auto render = [&] {
                render_variant(graph, *variant, frame.camera, 0, frame.gbuffer);
                graph.times();  // waits
            };
            render();  // compiles, and allocates
            seconds[kind_of(config)][size] = seconds_of(render);
        }
    }

    Device& device_;
    const RunSettings& settings_;
    Config config_;
    fs::path folder_;
};

/// What the process holds that does the cell: device, scene, G-buffers and a truth; a seed's images and what is
/// measured of them; copies that are timed. Bytes per pixel are those of the images' formats, rounded up. `quickstart`
/// held 762 MiB, for which this says 805; three shots of 96x54 203, for which it says 329. Larger images have not been
/// compared.
double memory_of(const ShotConfig& shot, size_t timed_copies) {
    constexpr double base_mib = 300, truth_bytes = 1500, seed_bytes = 600, gbuffer_bytes = 250, copy_bytes = 250;
    const double pixels = pixels_of(shot.extent);
    const double kept_mib = std::min(pixels * double(shot.frames.size()) * gbuffer_bytes / 1048576, 1024.0);
    return base_mib + kept_mib + pixels * (truth_bytes + seed_bytes + copy_bytes * double(timed_copies)) / 1048576;
}

}  // namespace

std::map<std::string, CellEstimate> estimate_cells(Device& device, const Config& config, const StudyPlan& plan,
                                                   const RunSettings& settings) {
    Calibration calibration(device, config, settings);
    const Rates rates = calibration.measure(config.shots.front());
    const unsigned samples =
        config.reference.max_samples > 0 ? config.reference.max_samples : ReferenceSettings::default_samples;
    std::map<std::string, CellEstimate> estimates;
    for (const PlannedShot& shot : plan.shots) {
        const double pixels = pixels_of(shot.config.extent);
        for (const PlannedCell& cell : shot.cells) {
            CellEstimate& estimate = estimates[cell.name];
            size_t copies = 0;
            if (cell.kind == CellKind::references) {
                const double ladder = needs_ladder(config) ? 2 : 1;
                double traced = config.has_reference && shot.config.gbuffer.empty()
                                    ? rates.per_sample * samples * pixels * ladder
                                    : 0;
                if (config.reference.max_seconds > 0) traced = std::min(traced, config.reference.max_seconds);
                estimate.seconds = rates.opening.at(pixels) + traced * cell.units;
            } else if (cell.kind == CellKind::renders) {
                const Line& step = rates.per_step.at(kind_of(*cell.variant));
                // What is fixed is paid by each seed, though it holds what only the first does: its images, and two
                // more plays with other light. So this rather tells too much.
                // frame.
                const double seeds = double(cell.variant->seeds.size());
                estimate.seconds = seeds * step.fixed + step.per_pixel * pixels * cell.units;
            } else if (cell.kind == CellKind::costs) {
                // Frames before the last are rendered as they are; counting takes several times a frame.
                if (const auto frame = rates.per_frame.find(kind_of(*cell.variant)); frame != rates.per_frame.end())
                    estimate.seconds = frame->second.at(pixels) * (cell.units + counting_factor) + compiling_seconds;
            } else {
                // Two copies of each point, and one that leaves nothing out, take turns.
                for (const VariantConfig& variant : config.variants)
                    if (variant.is_timed) {
                        estimate.seconds += 3 * rates.per_frame.at(kind_of(variant)).at(pixels) *
                                            (config.timing.frames + config.timing.warm_up);
                        copies += 3;
                    }
                estimate.seconds += rates.opening.at(pixels) + clock_proof_seconds;
            }
            estimate.memory_mib = memory_of(shot.config, copies);
        }
    }
    return estimates;
}
