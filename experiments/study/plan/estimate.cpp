#include "experiments/study/plan/estimate.h"

#include "experiments/study/measuring/shot_truth.h"
#include "experiments/study/measuring/times/timed_rounds.h"
#include "experiments/study/plan/calibration.h"
#include "groundtruth/reference/reference.h"
#include "metrics/video_jod.h"

#include <algorithm>
#include <set>
#include <utility>

namespace {

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
                return std::exchange(run_seconds_, 0.0) + rates_.of(shot).opening.at(pixels) +
                       (shot.has_probe ? rates_.of(shot).probe : 0) + of_references(shot, cell.units);
            case CellKind::renders:
                return of_compiling(*cell.technique) + of_renders(*cell.technique, shot);
            case CellKind::costs:
                return of_costs(cell, shot);
            case CellKind::times:
                return rates_.of(shot).opening.at(pixels) + of_times(shot, others) + std::exchange(proof_seconds_, 0.0);
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
        const ShotRates& rates = rates_.of(shot);
        return compared * (rates.guide.at(pixels) + of_samples(config_.reference, rates, pixels)) +
               std::max(frames - compared, 0.0) * lit_share *
                   of_samples(settings_of(config_, {}, false), rates, pixels);
    }

    /// Of one reference, without its guide.
    double of_samples(const ReferenceSettings& settings, const ShotRates& rates, double pixels) const {
        const auto [samples, seconds] = std::pair(settings.max_samples, settings.max_seconds * rates_.of_wall);
        if (samples == 0 && seconds > 0) return seconds;
        // How many samples an error takes is not known: then those that a reference has by default.
        const unsigned of_specular = samples > 0 ? samples : ReferenceSettings::default_samples;
        const unsigned of_both = settings.lit_samples > 0 ? std::min(settings.lit_samples, of_specular) : of_specular;
        const double of_one_lobe = of_specular - of_both + settings.adaptive_share * of_specular +
                                   (settings.adaptive_image ? settings.adaptive_share * of_both : 0.0);
        const double traced = rates.per_sample * pixels * (of_both + specular_share * of_one_lobe);
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
    const Calibration calibration = calibrate(device, config, settings);
    CellSeconds on_wall(calibration.of_wall, config), on_processors(calibration.of_processors, config);
    const auto timed = size_t(std::ranges::count_if(config.techniques, &PointConfig::is_timed));
    StudyEstimate study{.cells = {}, .load_of_others = calibration.load_of_others};
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
