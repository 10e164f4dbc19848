#include "experiments/study/plan/calibration.h"

#include "core/cpu_times.h"
#include "core/error.h"
#include "core/gpu/passes/clock.h"
#include "core/in_flight.h"
#include "core/leftovers.h"
#include "core/scene/scene_family.h"
#include "experiments/study/measuring/render_technique.h"
#include "experiments/study/shots/open_shot.h"
#include "experiments/study/shots/point_renders.h"
#include "groundtruth/reference/reference.h"
#include "variants/registry.h"

#include <algorithm>
#include <array>
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

Line line_through(const OfTwoSizes& seconds) {
    const double few = pixels_of(calibration_extents[0]), many = pixels_of(calibration_extents[1]);
    const double slope = std::max(seconds[1] - seconds[0], 0.0) / (many - few);
    return {std::max(seconds[0] - slope * few, 0.0), slope};
}

/// Measures on a folder of its own, which it removes. The next removes what a killed one left.
class SmallImages {
public:
    SmallImages(Device& device, const Config& config, const RunSettings& settings)
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
    ~SmallImages() {
        std::error_code error;
        fs::remove_all(folder_, error);
    }

    /// Points are measured in the first shot.
    void measure(const std::vector<const ShotConfig*>& shots) {
        const CpuTimes start = read_cpu_times();
        for (const ShotConfig* shot : shots) {
            const bool is_first = shot == shots.front();
            SpentOnShot& spent = shots_.emplace_back(scenery_of(*shot), SpentOnShot{}).second;
            measure_shot(*shot, spent, [&](OpenShot& run, size_t size) {
                if (is_first) measure_points(run, size);
            });
            if (is_first) measure_points(*open_without_reference(*shot, 2), 2);
        }
        const CpuTimes end = read_cpu_times();
        spent_ = {.wall = end.wall - start.wall, .processors = end.own - start.own};
        foreign_load_ = foreign_load(start, end);
    }

    /// Of all processors while measuring: the share that other programs took, in [0, 1]; none if not reported.
    std::optional<double> load_of_others() const { return foreign_load_; }

    /// `shot`: the first that was measured.
    Rates rates(const ShotConfig& shot, ByClock clock) const {
        const double on_wall = per_sample(shots_.front().second, &Spent::wall);
        Rates rates{.shots = {},
                    .of_wall = on_wall > 0 ? per_sample(shots_.front().second, clock) / on_wall : 1,
                    .of_processor = clock == &Spent::wall ? std::max(spent_.wall / spent_.processors, 1.0) : 1,
                    .clock_attempts = foreign_load_.value_or(0) > disturbing_load ? double(::clock_attempts) : 1,
                    .points = {}};
        for (const auto& [scenery, spent] : shots_) rates.shots.emplace_back(scenery, shot_rates(spent, clock));
        for (const auto& [kind, spent] : points_) rates.points[kind] = rates_of(spent, shot, clock);
        return rates;
    }

private:
    struct SpentOnShot {
        SpentOfTwoSizes opening{}, rendered{};
        Spent with_probe, longer;
    };
    struct SpentOnPoint {
        Spent compiling;
        SpentOfTwoSizes of_a_seed{}, of_two_seeds{};
        SpentOfAllSizes first_frame{}, last_frame{};
    };

    /// `on_open`: gets the shot at each of two sizes.
    void measure_shot(const ShotConfig& shot, SpentOnShot& spent,
                      const std::function<void(OpenShot& run, size_t size)>& on_open) {
        config_.reference.max_samples = few_samples;
        // The next images find the probe in the cache.
        if (shot.has_probe) spent.with_probe = spent_in([&] { open_without_reference(shot, 0); });
        for (size_t i = 0; i < spent.opening.size(); ++i) {
            spent.rendered[i] = spent_in([&] { open(shot, i); });
            std::unique_ptr<OpenShot> run;
            spent.opening[i] = spent_in([&] { run = open(shot, i); });
            on_open(*run, i);
        }
        config_.reference.max_samples = many_samples;
        spent.longer = spent_in([&] { open(shot, 0); });
    }

    void measure_points(OpenShot& run, size_t size) {
        for (const auto& [kind, ends] : ends_of_kinds_) {
            measure_frames(run, size, ends, points_[kind]);
            if (size < 2) measure_point(run, size, ends.first, points_[kind]);
        }
    }

    static double per_sample(const SpentOnShot& spent, ByClock clock) {
        // The longer reference continues the first one, whose guide and samples it finds in the cache.
        return std::max(spent.longer.*clock - spent.opening[0].*clock, 0.0) /
               (pixels_of(calibration_extents[0]) * (many_samples - few_samples));
    }

    static ShotRates shot_rates(const SpentOnShot& spent, ByClock clock) {
        const OfTwoSizes opening = by(clock, spent.opening), rendered = by(clock, spent.rendered);
        ShotRates rates{.opening = line_through(opening),
                        .guide = {},
                        .per_sample = per_sample(spent, clock),
                        .probe = std::max(spent.with_probe.*clock - opening[0], 0.0)};
        OfTwoSizes guide{};
        for (size_t i = 0; i < guide.size(); ++i)
            guide[i] = rendered[i] - opening[i] - rates.per_sample * few_samples * pixels_of(calibration_extents[i]);
        rates.guide = line_through(guide);
        return rates;
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
    std::vector<std::pair<std::string, SpentOnShot>> shots_;                    ///< by scenery_of()
    Spent spent_;
    std::optional<double> foreign_load_;
    std::map<std::string, SpentOnPoint> points_;  ///< by kind_of()
    const fs::path folder_ = unfinished_path(fs::temp_directory_path() / "ssrlab-plan");
};

/// The study's first shot, then the first shots of other sceneries, those with the most pixels first.
std::vector<const ShotConfig*> measured_shots(const Config& config) {
    constexpr size_t most_sceneries = 4;
    const std::string first = scenery_of(config.shots.front());
    std::vector<std::pair<double, const ShotConfig*>> others;
    std::map<std::string, size_t> places;
    for (const ShotConfig& shot : config.shots) {
        const std::string scenery = scenery_of(shot);
        if (scenery == first) continue;
        const size_t place = places.emplace(scenery, others.size()).first->second;
        if (place == others.size()) others.emplace_back(0, &shot);
        others[place].first += pixels_of(shot.extent) * double(shot.frames.size());
    }
    std::ranges::stable_sort(others, std::greater<>(), &std::pair<double, const ShotConfig*>::first);
    std::vector<const ShotConfig*> shots = {&config.shots.front()};
    for (size_t i = 0; i < std::min(others.size(), most_sceneries - 1); ++i) shots.push_back(others[i].second);
    return shots;
}

bool is_made_by_family(const std::string& scenery) { return scenery.ends_with(':'); }

}  // namespace

const ShotRates& Rates::of(const ShotConfig& shot) const {
    const std::string scenery = scenery_of(shot);
    const auto own = std::ranges::find(shots, scenery, &std::pair<std::string, ShotRates>::first);
    if (own != shots.end()) return own->second;
    const auto alike = std::ranges::find_if(
        shots, [&](const auto& other) { return is_made_by_family(other.first) == is_made_by_family(scenery); });
    return alike != shots.end() ? alike->second : shots.front().second;
}

std::string scenery_of(const ShotConfig& shot) {
    return is_of_family(shot.scene) ? shot.scene.substr(0, shot.scene.find(':') + 1) : shot.scene;
}

std::string kind_of(const PointConfig& technique) { return technique.technique + " " + technique.preset; }

unsigned plays_of_lit_noise(const Config& config, const ShotConfig& shot) {
    return config.measures_lit_noise && config.has_reference && !shot.direct_lit && shot.gbuffer.empty() ? 2 : 0;
}

Calibration calibrate(Device& device, const Config& config, const RunSettings& settings) {
    SmallImages images(device, config, settings);
    const std::vector<const ShotConfig*> shots = measured_shots(config);
    images.measure(shots);
    return {images.rates(*shots.front(), &Spent::wall), images.rates(*shots.front(), &Spent::processors),
            images.load_of_others()};
}
