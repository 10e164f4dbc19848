#include "experiments/study/plan/estimate.h"

#include "core/cpu_times.h"
#include "core/error.h"
#include "core/gpu/passes/clock.h"
#include "core/in_flight.h"
#include "core/leftovers.h"
#include "experiments/study/measuring/render_technique.h"
#include "experiments/study/measuring/shot_truth.h"
#include "experiments/study/measuring/times/timed_rounds.h"
#include "experiments/study/plan/growth.h"
#include "experiments/study/shots/open_shot.h"
#include "experiments/study/shots/point_renders.h"
#include "groundtruth/reference/reference.h"
#include "metrics/video_jod.h"
#include "variants/registry.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace fs = std::filesystem;

namespace {

/// Frames are rendered at all of these sizes, all else is measured at the first two.
constexpr std::array<glm::uvec2, 3> calibration_extents = {glm::uvec2(64, 36), glm::uvec2(128, 72),
                                                           glm::uvec2(320, 180)};
/// By two clocks: other programs lengthen what passes on the wall, and hardly what processors do.
struct Spent {
    double wall = 0, processors = 0;  // s; all threads of this process count
};
using ByClock = double Spent::*;
using OfTwoSizes = std::array<double, 2>;
using OfAllSizes = std::array<double, calibration_extents.size()>;
using SpentOfTwoSizes = std::array<Spent, 2>;
using SpentOfAllSizes = std::array<Spent, calibration_extents.size()>;
constexpr unsigned few_samples = 32, many_samples = 256;
/// Shares of a reference's time without its guide that its lit colour alone and its specular light alone take; of the
/// rays of three rooms the latter has 0.46 to 0.54. Both trace the first hits.
constexpr double lit_share = 0.6, specular_share = 0.5;
constexpr double compiling_seconds = 0.3, counting_factor = 5;
/// Of processors: what starts a run and ends with its page; one attempt at the proof of the clock. On a busy machine
/// all attempts are made (core/gpu/passes/clock.h).
constexpr double run_seconds = 0.5, clock_proof_seconds = 4;
constexpr double chip_seconds = 1;               // of one chip's compiler for the passes of a point
constexpr double external_pixel_seconds = 2e-6;  // of a frame of another program, read and measured
constexpr double tracing_factor = 15;            // a traced frame, with the replay of its waves, takes so many others

Spent spent_in(const std::function<void()>& work) {
    const CpuTimes start = read_cpu_times();
    work();
    const CpuTimes end = read_cpu_times();
    return {.wall = end.wall - start.wall, .processors = end.own - start.own};
}

template <size_t N>
std::array<double, N> by(ByClock clock, const std::array<Spent, N>& spent) {
    std::array<double, N> seconds{};
    for (size_t i = 0; i < N; ++i) seconds[i] = spent[i].*clock;
    return seconds;
}

double pixels_of(glm::uvec2 extent) { return double(extent.x) * double(extent.y); }

/// Seconds that grow with the number of pixels.
struct Line {
    double fixed = 0, per_pixel = 0;
    double at(double pixels) const { return fixed + per_pixel * pixels; }
};

Line line_through(const OfTwoSizes& seconds) {
    const double few = pixels_of(calibration_extents[0]), many = pixels_of(calibration_extents[1]);
    const double slope = std::max(seconds[1] - seconds[0], 0.0) / (many - few);
    return {std::max(seconds[0] - slope * few, 0.0), slope};
}

/// Points that are alike but for what a design varies.
std::string kind_of(const PointConfig& technique) { return technique.technique + " " + technique.preset; }

/// What a point of a kind takes.
struct PointRates {
    double compiling = 0;  ///< its shaders
    Line once;             ///< images, and what is measured of the point as a whole
    Line measure;          ///< a frame of a seed
    Growth frame;          ///< rendered: the mean of the first and the last point of the kind
};

/// How often a point is played besides its seeds: with the light of each half of a reference (point_run.cpp).
unsigned plays_of_lit_noise(const Config& config, const ShotConfig& shot) {
    return config.measures_lit_noise && config.has_reference && !shot.direct_lit && shot.gbuffer.empty() ? 2 : 0;
}

/// What was measured on small images, by one of the clocks.
struct Rates {
    Line opening;                              ///< a shot: its scene, its first frame, what is measured of the truth
    Line guide;                                ///< what a reference does before its samples
    double per_sample = 0;                     ///< seconds per pixel and sample of a reference
    double of_wall = 1;                        ///< seconds of this clock in a second of a reference on the wall
    double of_processor = 1;                   ///< seconds of this clock in a second of work for one processor
    double clock_attempts = 1;                 ///< at each check of the clock
    double probe = 0;                          ///< seconds of a reflection probe, if the shot has one
    std::map<std::string, PointRates> points;  ///< by kind_of()
};

/// Measures on a folder of its own, which it removes. The next removes what a killed one left.
class Calibration {
public:
    Calibration(Device& device, const Config& config, const RunSettings& settings)
        : device_(device), settings_(settings), config_(config) {
        remove_leftovers(folder_.parent_path());
        if (std::error_code error; !fs::create_directory(folder_, error))
            fail_machine("cannot create the folder ", folder_.string(), ": ",
                         error ? error.message() : "it is there already");
        for (const PointConfig& technique : config.techniques) {
            if (technique.external) continue;
            auto [ends, is_new] = ends_of_kinds_.try_emplace(kind_of(technique), technique, technique);
            ends->second.second = technique;
        }
        config_.reference = {.max_samples = few_samples,
                             .max_depth = config.reference.max_depth,
                             .guide_samples = config.reference.guide_samples};
    }
    ~Calibration() {
        std::error_code error;
        fs::remove_all(folder_, error);
    }

    void measure(const ShotConfig& shot) {
        const CpuTimes start = read_cpu_times();
        // The next images find the probe in the cache.
        if (shot.has_probe) with_probe_ = spent_in([&] { open_without_reference(shot, 0); });
        for (size_t i = 0; i < opening_.size(); ++i) {
            rendered_[i] = spent_in([&] { open(shot, i); });
            std::unique_ptr<OpenShot> run;
            opening_[i] = spent_in([&] { run = open(shot, i); });
            for (const auto& [kind, ends] : ends_of_kinds_) {
                measure_frames(*run, i, ends, points_[kind]);
                measure_point(*run, i, ends.first, points_[kind]);
            }
        }
        {
            const std::unique_ptr<OpenShot> largest = open_without_reference(shot, 2);
            for (const auto& [kind, ends] : ends_of_kinds_) measure_frames(*largest, 2, ends, points_[kind]);
        }
        config_.reference.max_samples = many_samples;
        longer_ = spent_in([&] { open(shot, 0); });
        const CpuTimes end = read_cpu_times();
        spent_ = {.wall = end.wall - start.wall, .processors = end.own - start.own};
        foreign_load_ = foreign_load(start, end);
    }

    /// Of all processors while measuring: the share that other programs took, in [0, 1]; none if not reported.
    std::optional<double> load_of_others() const { return foreign_load_; }

    /// Of the shot that was measured.
    Rates rates(const ShotConfig& shot, ByClock clock) const {
        const OfTwoSizes opening = by(clock, opening_), rendered = by(clock, rendered_);
        Rates rates{.opening = line_through(opening),
                    .guide = {},
                    .per_sample = per_sample(clock),
                    .of_wall = per_sample(&Spent::wall) > 0 ? per_sample(clock) / per_sample(&Spent::wall) : 1,
                    .of_processor = clock == &Spent::wall ? std::max(spent_.wall / spent_.processors, 1.0) : 1,
                    .clock_attempts = foreign_load_.value_or(0) > disturbing_load ? double(::clock_attempts) : 1,
                    .probe = std::max(with_probe_.*clock - opening[0], 0.0),
                    .points = {}};
        OfTwoSizes guide{};
        for (size_t i = 0; i < guide.size(); ++i)
            guide[i] = rendered[i] - opening[i] - rates.per_sample * few_samples * pixels_of(calibration_extents[i]);
        rates.guide = line_through(guide);
        for (const auto& [kind, spent] : points_) rates.points[kind] = rates_of(spent, shot, clock);
        return rates;
    }

private:
    struct SpentOnPoint {
        Spent compiling;
        SpentOfTwoSizes of_a_seed{}, of_two_seeds{};
        SpentOfAllSizes first_frame{}, last_frame{};
    };

    double per_sample(ByClock clock) const {
        // The longer reference continues the first one, whose guide and samples it finds in the cache.
        return std::max(longer_.*clock - opening_[0].*clock, 0.0) /
               (pixels_of(calibration_extents[0]) * (many_samples - few_samples));
    }

    PointRates rates_of(const SpentOnPoint& spent, const ShotConfig& shot, ByClock clock) const {
        const OfTwoSizes of_a_seed = by(clock, spent.of_a_seed), of_two_seeds = by(clock, spent.of_two_seeds);
        const OfAllSizes first_frame = by(clock, spent.first_frame), last_frame = by(clock, spent.last_frame);
        OfTwoSizes once{}, measure{};
        for (size_t i = 0; i < once.size(); ++i) {
            const double seed = of_two_seeds[i] - of_a_seed[i];
            once[i] = of_a_seed[i] - seed - plays_of_lit_noise(config_, shot) * first_frame[i];
            measure[i] = seed - first_frame[i];
        }
        OfAllSizes frame{}, pixels{};
        for (size_t i = 0; i < frame.size(); ++i) {
            frame[i] = (first_frame[i] + last_frame[i]) / 2;
            pixels[i] = pixels_of(calibration_extents[i]);
        }
        return {.compiling = spent.compiling.*clock,
                .once = line_through(once),
                .measure = line_through(measure),
                .frame = growth_through(pixels, frame)};
    }

    std::unique_ptr<OpenShot> open_without_reference(ShotConfig shot, size_t size) {
        shot.direct_lit = true;
        const bool has_reference = std::exchange(config_.has_reference, false);
        std::unique_ptr<OpenShot> opened = open(shot, size);
        config_.has_reference = has_reference;
        return opened;
    }

    /// A still frame of the shot; of a capture its own size.
    std::unique_ptr<OpenShot> open(const ShotConfig& shot, size_t size) {
        ShotConfig small = shot;
        small.extent = calibration_extents[size], small.frames = {shot.frames.front()};
        small.warm_up = 0, small.repeat = 1, small.measure_from = shot.frames.front();
        small.change.reset();
        return open_shot(device_, small, config_,
                         {.out = folder_,
                          .cache = folder_ / "cache",
                          .search_path = settings_.search_path,
                          .keep_all = settings_.keep_all,
                          .say = [](const std::string&) {},
                          .report = [](double, const std::string&) {}});
    }

    void measure_point(OpenShot& run, size_t size, PointConfig technique, SpentOnPoint& spent) {
        const bool is_first_size = size == 0;  // compiles
        const auto play = [&](std::vector<unsigned> seeds) {
            technique.seeds = std::move(seeds);
            return spent_in([&] {
                SpentTime unused;
                render_point(device_, run.shot, run.truth, *run.store, config_, technique,
                             {.out = folder_,
                              .image_suffix = "plan",
                              .keep_all = settings_.keep_all,
                              .report = [](double) {},
                              .spent = unused});
            });
        };
        if (is_first_size) play({0});
        spent.of_a_seed[size] = play({0});
        spent.of_two_seeds[size] = play({0, 1});
    }

    void measure_frames(OpenShot& run, size_t size, const std::pair<PointConfig, PointConfig>& ends,
                        SpentOnPoint& spent) {
        const InFlightText technique(in_flight().technique, ends.first.technique),
            point(in_flight().point, ends.first.point);
        if (size == 0) spent.compiling = spent_in([&] { spent_on_frame(run, ends.first); });
        spent.first_frame[size] = spent_on_frame(run, ends.first);
        spent.last_frame[size] =
            ends.second.point == ends.first.point ? spent.first_frame[size] : spent_on_frame(run, ends.second);
    }

    Spent spent_on_frame(OpenShot& run, const PointConfig& config) {
        const FrameStep& step = run.shot.steps.front();
        const FrameStore::Frame frame = run.store->frame(step, run.truth.lit(step));
        PassList pass_list(device_, run.shot.config.extent);
        const std::unique_ptr<Technique> technique = make_technique(config.technique, config.parameters, config.preset);
        RayProbe probe;  // exact_scene uses scene data, at a cost of its own: here it meets nothing
        probe.exact_hits = [](const RecordedRays& recorded) { return std::vector<ExactHit>(recorded.rays.size()); };
        probe.answers = [](const RecordedRays& marched, const AskedRays&) {
            return std::vector<ExactHit>(marched.rays.size());
        };
        technique->ray_probe = &probe;
        if (!settings_.keep_all) technique->leave_out(run.shot.facts);
        const auto render = [&] {
            render_technique(pass_list, *technique, frame.camera, 0, frame.gbuffer);
            pass_list.times();  // waits
        };
        render();  // compiles, and allocates
        std::array<Spent, 3> spent{};
        for (Spent& s : spent) s = spent_in(render);
        const auto median = [&](ByClock clock) {
            std::array<double, 3> seconds = by(clock, spent);
            std::ranges::sort(seconds);
            return seconds[1];
        };
        return {.wall = median(&Spent::wall), .processors = median(&Spent::processors)};
    }

    Device& device_;
    const RunSettings& settings_;
    Config config_;
    std::map<std::string, std::pair<PointConfig, PointConfig>> ends_of_kinds_;  ///< first and last point
    Spent with_probe_, longer_, spent_;
    std::optional<double> foreign_load_;
    SpentOfTwoSizes opening_{}, rendered_{};
    std::map<std::string, SpentOnPoint> points_;  ///< by kind_of()
    const fs::path folder_ = unfinished_path(fs::temp_directory_path() / "ssrlab-plan");
};

/// What the process holds at most that does a cell of the shot: device, scene, G-buffer and truth; then either copies
/// that are timed, each with its images and compiled shaders, or a point's images with what is measured of them, and
/// the compiled shaders of all points, which the driver keeps. Fitted above what was held:
///
/// | | said (MiB) | held |
/// |---|---|---|
/// | 640x360: rendering 1 (`none`) and 4 points, timing 12 copies | 643, 748, 917 | 460, 628, 796 |
/// | 1920x1080: rendering 1, 4 and 7 points, timing 21 copies | 4071, 4176, 4281, 8261 | 3162, 3704, 3710, 6228 |
/// | 256x144, `quickstart`: rendering, timing | 783, 871 | 687, 764 |
/// | 192x108, `quality`: counting, timing | 1288, 2107 | 823, 2013 |
double memory_of(const ShotConfig& shot, const Config& config, size_t timed_copies) {
    constexpr double base_mib = 180, copy_mib = 10, point_mib = 10, kind_mib = 25, most_kept_mib = 1024;
    constexpr double truth_bytes = 1250, render_bytes = 700, frame_bytes = 250, copy_bytes = 130;  // per pixel
    const double mib_of_byte = pixels_of(shot.extent) / 1048576;
    const double kept_mib = std::min(mib_of_byte * double(shot.frames.size() - 1) * frame_bytes, most_kept_mib);
    const double held_mib = base_mib + kept_mib + mib_of_byte * truth_bytes;
    if (timed_copies > 0) return held_mib + double(timed_copies) * (copy_mib + mib_of_byte * copy_bytes);
    std::set<std::string> kinds;
    for (const PointConfig& technique : config.techniques) kinds.insert(kind_of(technique));
    const double video_bytes = measures_video(shot, config) ? VideoJod::bytes_per_pixel() : 0;
    return held_mib + mib_of_byte * (render_bytes + video_bytes) + point_mib * double(config.techniques.size()) +
           kind_mib * double(kinds.size());
}

/// Seconds of a study's cells, by the clock of the rates.
class CellSeconds {
public:
    CellSeconds(const Rates& rates, const Config& config) : rates_(rates), config_(config) {}

    /// In the order of the plan: the first times come with the proof of the clock. `others`: of the shot's cells
    /// before.
    double of(const PlannedCell& cell, const ShotConfig& shot, double others) {
        const double pixels = pixels_of(shot.extent);
        switch (cell.kind) {
            case CellKind::references:
                return std::exchange(run_seconds_, 0.0) + rates_.opening.at(pixels) +
                       (shot.has_probe ? rates_.probe : 0) + of_references(shot, cell.units);
            case CellKind::renders:
                return of_compiling(*cell.technique) + of_renders(*cell.technique, shot);
            case CellKind::costs:
                return of_costs(cell, shot);
            case CellKind::times:
                return rates_.opening.at(pixels) + of_times(shot, others) + std::exchange(proof_seconds_, 0.0);
        }
        return 0;
    }

    /// Two copies of each point, and, of those that leave anything out, one that does not.
    unsigned copies_timed() const { return config_.timing.has_copies ? 3 : 1; }

private:
    /// Once in a process.
    double of_compiling(const PointConfig& technique) {
        if (technique.external || !compiled_.insert(&technique).second) return 0;
        return rates_.points.at(kind_of(technique)).compiling;
    }

    double of_costs(const PlannedCell& cell, const ShotConfig& shot) const {
        const double frame = frame_of(*cell.technique, shot), chips = double(config_.gpu_compilers.size());
        // Frames before the last are rendered as they are; counting takes several times a frame.
        const double counted = frame * (cell.units + counting_factor) + compiling_seconds;
        double seconds = config_.counts_costs ? counted : 0;
        if (chips > 0) seconds += 2 * frame + chips * chip_seconds;
        // Once more counted, and once traced.
        if (config_.counts_costs && chips > 0)
            seconds += 2 * counted + frame * tracing_factor + chips * 2 * chip_seconds;
        return seconds;
    }

    double of_references(const ShotConfig& shot, double frames) const {
        if (!config_.has_reference || !shot.gbuffer.empty()) return 0;
        const double compared = double(compared_frames({.config = shot, .steps = timeline(shot)}).size());
        const double pixels = pixels_of(shot.extent);
        return compared * (rates_.guide.at(pixels) + of_samples(config_.reference, pixels)) +
               std::max(frames - compared, 0.0) * lit_share * of_samples(settings_of(config_, {}, false), pixels);
    }

    /// Of one reference, without its guide.
    double of_samples(const ReferenceSettings& settings, double pixels) const {
        const auto [samples, seconds] = std::pair(settings.max_samples, settings.max_seconds * rates_.of_wall);
        if (samples == 0 && seconds > 0) return seconds;
        // How many samples an error takes is not known: then those that a reference has by default.
        const unsigned of_specular = samples > 0 ? samples : ReferenceSettings::default_samples;
        const unsigned of_both = settings.lit_samples > 0 ? std::min(settings.lit_samples, of_specular) : of_specular;
        const double of_specular_alone = of_specular * (1.0 + settings.adaptive_share) - of_both;
        const double traced = rates_.per_sample * pixels * (of_both + specular_share * of_specular_alone);
        return seconds > 0 ? std::min(traced, double(seconds)) : traced;
    }

    double of_renders(const PointConfig& technique, const ShotConfig& shot) const {
        const double pixels = pixels_of(shot.extent), seeds = double(technique.seeds.size());
        const std::vector<FrameStep> steps = timeline(shot);
        const auto measured = double(std::ranges::count_if(steps, &FrameStep::is_measured));
        if (technique.external) return external_pixel_seconds * pixels * measured * seeds;
        const PointRates& rates = rates_.points.at(kind_of(technique));
        return rates.once.at(pixels) + rates.measure.at(pixels) * measured * seeds +
               rates.frame.at(pixels) * double(steps.size()) * (seeds + plays_of_lit_noise(config_, shot));
    }

    double of_times(const ShotConfig& shot, double others) const {
        double round = 0;
        for (const PointConfig& technique : config_.techniques)
            if (technique.is_timed) round += frame_of(technique, shot);
        const double all = round * copies_timed() * (config_.timing.frames + config_.timing.warm_up),
                     least = round * (least_rounds + copies_timed() * config_.timing.warm_up);
        return std::min(all, std::max(least, config_.timing.most_share * others));
    }

    double frame_of(const PointConfig& technique, const ShotConfig& shot) const {
        return rates_.points.at(kind_of(technique)).frame.at(pixels_of(shot.extent));
    }

    const Rates& rates_;
    const Config& config_;
    double run_seconds_ = run_seconds * rates_.of_processor,
           proof_seconds_ = clock_proof_seconds * rates_.clock_attempts * rates_.of_processor;
    std::set<const PointConfig*> compiled_;
};

}  // namespace

StudyEstimate estimate_study(Device& device, const Config& config, const StudyPlan& plan, const RunSettings& settings) {
    Calibration calibration(device, config, settings);
    const ShotConfig& calibrated = config.shots.front();
    calibration.measure(calibrated);
    const Rates of_wall = calibration.rates(calibrated, &Spent::wall),
                of_processors = calibration.rates(calibrated, &Spent::processors);
    CellSeconds on_wall(of_wall, config), on_processors(of_processors, config);
    const auto timed = size_t(std::ranges::count_if(config.techniques, &PointConfig::is_timed));
    StudyEstimate study{.cells = {}, .load_of_others = calibration.load_of_others()};
    for (const PlannedShot& shot : plan.shots) {
        CellEstimate others;
        for (const PlannedCell& cell : shot.cells) {
            const CellEstimate& estimate = study.cells[cell.name] = {
                .seconds = on_wall.of(cell, shot.config, others.seconds),
                .processor_seconds = on_processors.of(cell, shot.config, others.processor_seconds),
                .memory_mib =
                    memory_of(shot.config, config, cell.kind == CellKind::times ? on_wall.copies_timed() * timed : 0)};
            others.seconds += estimate.seconds, others.processor_seconds += estimate.processor_seconds;
        }
    }
    return study;
}
