// The table of reflection probes in metrics/coverage.md, to standard output:
// probe_coverage_study [REFERENCES] [SAMPLES]
#include "core/error.h"
#include "core/files.h"
#include "core/gpu/device.h"
#include "experiments/results/verdicts/summary.h"
#include "experiments/study/measuring/reflection_probe.h"
#include "experiments/study/shots/point_renders.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace {

namespace fs = std::filesystem;

constexpr unsigned truth_factor = 32;            ///< samples of the truth over those of a reference
constexpr unsigned first_other_seed = 1u << 31;  ///< of probes that no study has

using Summaries = std::map<std::string, MetricSummary>;  ///< by technique and metric

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A room in which reflections fall back to a probe.
class Room {
public:
    Room(Device& device, const std::string& scene, const fs::path& folder) : device_(device), folder_(folder) {
        const fs::path file = folder / "study.json";
        write_text(file, R"({"shots": [{"scene": ")" + scene + R"(", "resolution": [64, 36]}], "fallback": "probe",
            "techniques": [{"technique": "none"}, {"technique": "mcguire_dda"}], "seeds": 1,
            "metrics": ["mse", "relmse", "flip", "mae"], "frame_metrics": [], "masks": "reflective",
            "targets": "specular", "reference": {"guide_samples": 16}})");
        config_ = read_config(file);
        for (const PointConfig& v : config_.techniques)
            if (!v.depends_on_seed) without_seeds_.insert({v.technique, v.point});
        shot_ = load_shot(config_.shots[0], {fs::path(SSRLAB_SOURCE_DIR) / "scenes"});
        now_ = shot_frame(shot_, 0);
    }

    Reference reference(unsigned samples, unsigned seed) const {
        ReferenceSettings settings = config_.reference;
        settings.max_samples = samples, settings.seed = seed;
        return render_reference(shot_.scene, now_.scene, now_.camera, shot_.config.extent, settings);
    }

    /// The study's own; with a number the same of other seeds.
    Environment probe(std::optional<unsigned> number = {}) const {
        unsigned seed = first_other_seed + probe_views * number.value_or(0);
        return reflection_probe(now_.camera.world_from_view[3], config_.reference,
                                [&](const CameraPose& camera, glm::uvec2 extent, ReferenceSettings of_view) {
                                    if (number) of_view.seed = seed++;
                                    return render_reference(shot_.scene, now_.scene, camera, extent, of_view);
                                });
    }

    Summaries play(const Environment& probe, const Reference& reference) const {
        const std::unique_ptr<FrameSource> source = scene_source(device_, shot_, config_, false, &probe);
        FrameStore store(*source, shot_.config, size_t(1) << 28);
        const ShotTruth truth =
            shot_truth(shot_, config_, store, source->pass_list(), [&](unsigned, ReferenceUse) { return reference; });
        Summaries all;
        for (const PointConfig& technique : config_.techniques) {
            SpentTime unused;
            const Cell cell =
                render_point(device_, shot_, truth, store, config_, technique,
                             {.out = folder_, .image_suffix = "x", .report = [](double) {}, .spent = unused});
            for (const MetricSummary& s : summarise(cell.results, without_seeds_))
                all[technique.technique + "` | `" + s.metric] = s;
        }
        return all;
    }

private:
    Device& device_;
    fs::path folder_;
    Config config_;
    PointSet without_seeds_;
    Shot shot_;
    ShotFrame now_;
};

struct Count {
    double intervals = 0, covered = 0, half_width = 0;

    void add(const MetricSummary& s, double truth) {
        if (!s.low || !s.high || !s.ranked) return;
        ++intervals, covered += *s.low <= truth && truth <= *s.high, half_width += (*s.high - *s.low) / 2;
    }
};

std::string of_intervals(const Count& c, unsigned references) {
    if (c.intervals == 0) return "none";
    char text[64];
    std::snprintf(text, sizeof text, "%.0f %% of %.0f %%", 100 * c.covered / c.intervals,
                  100 * c.intervals / references);
    return text;
}

/// Of probes drawn with each reference the truth is the mean over all of them.
void study(const std::string& scene, const Room& room, unsigned references, unsigned samples) {
    const auto start = std::chrono::steady_clock::now();
    const Environment own = room.probe();
    const double probe_seconds = seconds_since(start);
    const Reference truth = room.reference(truth_factor * samples, references);
    const Summaries of_truth = room.play(own, truth);
    std::vector<Summaries> with_own, with_drawn, drawn_of_truth;
    double reference_seconds = 0;
    for (unsigned i = 0; i < references; ++i) {
        const Reference reference = room.reference(samples, i);
        reference_seconds += reference.seconds / references;
        const Environment drawn = room.probe(i);
        with_own.push_back(room.play(own, reference)), with_drawn.push_back(room.play(drawn, reference));
        drawn_of_truth.push_back(room.play(drawn, truth));
    }
    for (const auto& [key, s] : of_truth) {
        double mean = 0, squares = 0;
        for (const Summaries& d : drawn_of_truth) mean += *d.at(key).value / references;
        for (const Summaries& d : drawn_of_truth) squares += std::pow(*d.at(key).value - mean, 2);
        Count of_own, of_drawn;
        for (const Summaries& d : with_own) of_own.add(d.at(key), *s.value);
        for (const Summaries& d : with_drawn) of_drawn.add(d.at(key), mean);
        std::printf("| %s | `%s` | %.2f %% | %.2f %% | %.2f %% | %s | %s |\n", scene.c_str(), key.c_str(),
                    100 * of_own.half_width / of_own.intervals / mean,
                    100 * std::sqrt(squares / (references - 1)) / mean, 100 * (*s.value / mean - 1),
                    of_intervals(of_drawn, references).c_str(), of_intervals(of_own, references).c_str());
    }
    std::fflush(stdout);
    std::fprintf(stderr, "%s: a probe takes %.1f s, a reference %.1f s\n", scene.c_str(), probe_seconds,
                 reference_seconds);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const unsigned references = argc > 1 ? unsigned(std::atoi(argv[1])) : 24,
                       samples = argc > 2 ? unsigned(std::atoi(argv[2])) : 64;
        Device device;
        const fs::path folder = fs::temp_directory_path() / "probe_coverage_study";
        fs::create_directories(folder);
        std::printf(
            "| scene | technique | metric | half-width of the interval | deviation over probes | the study's probe "
            "less "
            "their mean | covered, another probe with each reference | covered, the study's probe |\n"
            "|---|---|---|---|---|---|---|---|\n");
        for (const char* scene : {"dark_room", "room:3"})
            study(scene, Room(device, scene, folder), references, samples);
        fs::remove_all(folder);
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
