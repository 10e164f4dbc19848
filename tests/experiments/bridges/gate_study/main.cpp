// What `ssrlab judge` sees as a gate: defects of known strength are put into frames of a technique, and judge's own
// decision is asked of them. Runs without a defect show how often it is wrong.
//
//     gate_study GATE.csv [RUNS [DRAWS [TECHNIQUE]]]
//
// Each scene gets RUNS comparisons without a defect, and DRAWS with each defect. GATE.csv gets the counts of each
// scene, of which `python3 experiments/python gate_page` makes the tables and the picture of experiments/docs/gate.md.
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/gpu/device.h"
#include "experiments/bridges/judge.h"
#include "experiments/results/cells/study_rows.h"
#include "experiments/results/verdicts/judge_rows.h"
#include "experiments/study/config/comparisons.h"
#include "experiments/study/measuring/render_technique.h"
#include "experiments/study/shots/open_shot.h"
#include "experiments/study/shots/point_errors.h"
#include "experiments/study/shots/result_images.h"
#include "tests/experiments/bridges/gate_study/defects.h"
#include "tests/experiments/study/external_fixture.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

namespace {

constexpr unsigned width = 96, height = 54, samples = 128;
constexpr std::array tolerances = {1.0, 1.05};

/// Frames of a technique. The first half of `pool` runs are earlier frames, the others get defects; a side of a
/// comparison has `seeds` of them. A technique without random numbers needs one run a side.
struct Renderings {
    const char* technique;
    unsigned pool, seeds;

    unsigned half() const { return pool / 2; }
    bool depends_on_seed() const { return seeds > 1; }
};
constexpr Renderings renderings[] = {{"frostbite_sssr", 24, 8}, {"mcguire_dda", 2, 1}};

struct GateScene {
    const char *scene, *camera;
};
constexpr GateScene scenes[] = {{"moving_objects", "main"},     {"moving_emitter", "main"},
                                {"passing_pillars", "lateral"}, {"mirror_pillars", "dolly"},
                                {"disocclusion", "lateral"},    {"rotating_mirror", "main"}};

/// Verdicts of one kind and strength in one scene, with either tolerance.
struct Counts {
    unsigned runs = 0;
    std::array<unsigned, 2> worse = {}, better = {};
    unsigned error = 0, flicker = 0, ghosts = 0, visibility = 0;  ///< worse without a tolerance
};

class Gate {
public:
    Gate(Device& device, const GateScene& scene, const Renderings& of, fs::path folder)
        : folder_(std::move(folder)), scene_(scene), of_(of) {
        char text[900];
        std::snprintf(
            text, sizeof text,
            R"({"shots": [{"scene": "%s", "camera": "%s", "resolution": [%u, %u], "frames": [10, 11, 12, 13, 14, 15]}],
            "techniques": [{"technique": "none"}, {"technique": "%s", "seeds": %u}], "reference": {"samples": %u},
            "metrics": ["mse", "cvvdp_0_5_6"], "masks": ["all", "reflective", "disoccluded"], "targets": ["specular", "image"],
            "timing": {"frames": 0}})",
            scene.scene, scene.camera, width, height, of.technique, of.pool, samples);
        write_text(folder_ / "study.json", text);
        config_ = read_config(folder_ / "study.json");
        config_.kept_images = KeptImages::none;
        open_ = open_shot(device, config_.shots.front(), config_,
                          {.out = folder_ / "out",
                           .cache = folder_ / "cache",
                           .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                           .say = [](const std::string&) {},
                           .report = [](double, const std::string&) {}});
        const std::vector<HostImage> missed = render(device, config_.techniques[0], 0);
        for (unsigned seed = 0; seed < of_.pool; ++seed) {
            PlayedFrames& run = runs_.emplace_back(
                PlayedFrames{.shown = render(device, config_.techniques[1], seed), .missed = missed});
            for (const FrameStep& step : open_->shot.steps) {
                const FrameTruth& truth = *open_->truth.frame(step);
                run.is_new.push_back(pixels_of(truth, "disoccluded"));
                run.reflects.push_back(pixels_of(truth, "reflective"));
            }
        }
        clean_ = measured("clean", 0, [](const PlayedFrames& run, std::mt19937&) { return run.shown; });
    }

    bool changes(const Defect& defect) const {
        std::mt19937 random(1);
        const std::vector<HostImage> made = defect.apply(runs_.front(), random);
        for (size_t t = 0; t < made.size(); ++t)
            if (made[t].values != runs_.front().shown[t].values) return true;
        return false;
    }

    Counts with_defect(const Defect& defect, unsigned draws) const {
        const MeasuredRows broken = measured("defect", of_.half(), defect.apply);
        Counts counts;
        std::mt19937 random(7);
        for (unsigned draw = 0; draw < draws; ++draw) {
            const std::vector<unsigned> before = drawn(random, 0, of_.half(), of_.seeds),
                                        now = drawn(random, of_.half(), of_.pool, of_.seeds);
            count(counts, broken, now, before);
        }
        return counts;
    }

    Counts without_defect(unsigned count_of_runs) const {
        Counts counts;
        std::mt19937 random(11);
        for (unsigned run = 0; run < count_of_runs; ++run) {
            const std::vector<unsigned> both = drawn(random, 0, of_.pool, 2 * of_.seeds);
            count(counts, clean_, {both.begin(), both.begin() + of_.seeds}, {both.begin() + of_.seeds, both.end()});
        }
        return counts;
    }

    /// Whether `ssrlab judge` refuses frames with a NaN in one pixel of one image.
    bool refuses_nan() const {
        const fs::path frames = folder_ / "nan";
        describe_frames(frames);
        const fs::path view = frames / (std::string(scene_.scene) + "." + scene_.camera + "." + std::to_string(width) +
                                        "x" + std::to_string(height));
        const FrameStep& step = open_->shot.steps.back();
        const HostImage& off = open_->truth.pose(step).direct;
        HostImage image = sum(off, runs_.front().shown.back());
        image.values[image.values.size() / 2] = NAN;
        write_exr(view / ("f" + std::to_string(step.frame) + ".off.exr"), off);
        write_exr(view / ("f" + std::to_string(step.frame) + ".s0.exr"), image);
        try {
            judge_frames({.frames = frames,
                          .samples = 32,
                          .run = {.out = folder_ / "judged",
                                  .cache = folder_ / "cache",
                                  .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"}}});
        } catch (const Error& e) {
            return std::string(e.what()).find("NaN") != std::string::npos;
        }
        return false;
    }

private:
    /// None of the first frame, which has no frame before, are new.
    static std::vector<uint8_t> pixels_of(const FrameTruth& truth, const std::string& mask) {
        std::vector<uint8_t> inside = std::ranges::find(truth.masks, mask, &Mask::name)->inside;
        inside.resize(size_t(width) * height);
        return inside;
    }

    std::vector<HostImage> render(Device& device, const PointConfig& point, unsigned seed) const {
        const Renderer renderer(device, open_->shot.config.extent, point, config_.composite);
        std::vector<HostImage> frames;
        for (const FrameStep& step : open_->shot.steps) {
            const FrameStore::Frame frame = open_->store->frame(step, open_->truth.lit(step));
            const Reflections reflections = renderer.render(frame.camera, seed, frame.gbuffer);
            const Composite composite = renderer.compositor->render(frame.gbuffer, reflections);
            frames.push_back(download_results(*renderer.pass_list, frame.gbuffer, reflections, composite,
                                              open_->truth.frame(step)->reflectance)
                                 .specular);
        }
        return frames;
    }

    /// The rows of all runs from `first` on, as judge's study measures another program's frames.
    template <class Apply>
    MeasuredRows measured(const std::string& point, unsigned first, const Apply& apply) const {
        const PointConfig config = side(point, false);
        const PointInShot in_shot{.shot = open_->shot, .truth = open_->truth, .config = config_, .technique = config};
        PointErrors errors(in_shot, unknown_lit_noise);
        for (unsigned seed = first; seed < of_.pool; ++seed) {
            std::mt19937 random(seed);
            const std::vector<HostImage> frames = apply(runs_[seed], random);
            SeedErrors of_seed{.seed = seed};
            for (size_t t = 0; t < frames.size(); ++t)
                errors.add(
                    of_seed, open_->shot.steps[t],
                    {.specular = frames[t], .image = sum(open_->truth.pose(open_->shot.steps[t]).direct, frames[t])});
            errors.add_whole(of_seed);
        }
        Cell cell;
        errors.move_to(cell);
        std::vector<Cell> cells;
        cells.push_back(std::move(cell));
        return rows_of(cells);
    }

    PointConfig side(const std::string& point, bool is_baseline) const {
        PointConfig v{.technique = "frames", .preset = "", .parameters = {}, .swept = {}, .point = point};
        v.seeds.resize(of_.seeds), v.is_baseline = is_baseline, v.depends_on_seed = of_.depends_on_seed();
        std::iota(v.seeds.begin(), v.seeds.end(), 0u);
        return v;
    }

    static std::vector<unsigned> drawn(std::mt19937& random, unsigned first, unsigned end, unsigned count) {
        std::vector<unsigned> order(end - first);
        std::iota(order.begin(), order.end(), first);
        std::shuffle(order.begin(), order.end(), random);
        order.resize(count);
        return order;
    }

    /// Adds the rows of `runs`, as seeds 0, 1, ... of the point `as`.
    static void take(const MeasuredRows& from, const std::vector<unsigned>& runs, const std::string& as,
                     MeasuredRows& to) {
        for (const ResultRow& row : from.results) {
            const auto place = std::ranges::find(runs, row.seed);
            if (place == runs.end()) continue;
            to.results.push_back(row);
            to.results.back().point = as, to.results.back().seed = unsigned(place - runs.begin());
        }
        for (const ReferenceNoise& noise : from.reference_noise) {
            to.reference_noise.push_back(noise);
            to.reference_noise.back().point = as;
        }
    }

    void count(Counts& counts, const MeasuredRows& now_rows, const std::vector<unsigned>& now,
               const std::vector<unsigned>& before) const {
        MeasuredRows rows;
        take(now_rows, now, "now", rows), take(clean_, before, "before", rows);
        const std::vector<PointConfig> sides = {side("now", false), side("before", true)};
        ++counts.runs;
        for (size_t i = 0; i < tolerances.size(); ++i) {
            const Judgement judged = judge_rows(rows, compared_points(sides), {}, config_.primary, {"frames", "now"},
                                                {"frames", "before"}, {.worse_by = tolerances[i]});
            counts.worse[i] += judged.verdict == judgement::worse,
                counts.better[i] += judged.verdict == judgement::better;
            if (i > 0) continue;
            for (const JudgedView& view : judged.views) {
                const unsigned is_worse = view.verdict == judgement::worse;
                (view.what == judged_number::error     ? counts.error
                 : view.what == judged_number::flicker ? counts.flicker
                 : view.what == judged_number::ghosts  ? counts.ghosts
                                                       : counts.visibility) += is_worse;
            }
        }
    }

    fs::path folder_;
    GateScene scene_;
    Renderings of_;
    Config config_;
    std::unique_ptr<OpenShot> open_;
    std::vector<PlayedFrames> runs_;
    MeasuredRows clean_;
};

void write(std::FILE* file, const char* technique, const std::string& kind, const std::string& strength,
           const char* scene, const Counts& c) {
    std::fprintf(file, "%s,%s,%s,%s,%u,%u,%u,%u,%u,%u,%u,%u,%u\n", technique, kind.c_str(), strength.c_str(), scene,
                 c.runs, c.worse[0], c.better[0], c.error, c.flicker, c.ghosts, c.visibility, c.worse[1], c.better[1]);
    std::fflush(file);
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 2) fail("usage: gate_study GATE.csv [RUNS [DRAWS [TECHNIQUE]]]");
    const unsigned runs = argc > 2 ? unsigned(std::atoi(argv[2])) : 84,
                   draws = argc > 3 ? unsigned(std::atoi(argv[3])) : 3;
    std::FILE* const file = std::fopen(argv[1], "w");
    if (!file) fail_machine(argv[1], " cannot be written");
    std::fprintf(
        file,
        "technique,kind,strength,scene,runs,worse,better,worse_error,worse_flicker,worse_ghosts,worse_visibility,worse_"
        "tolerance,better_tolerance\n");
    const fs::path folder = fs::temp_directory_path() / ("ssrlab-gate-study-" + std::to_string(getpid()));
    Device device;
    for (const Renderings& of : renderings) {
        if (argc > 4 && std::string(of.technique) != argv[4]) continue;
        for (const GateScene& scene : scenes) {
            fs::remove_all(folder), fs::create_directories(folder);
            const Gate gate(device, scene, of, folder);
            const auto keep = [&](const std::string& kind, const std::string& strength, const Counts& counts) {
                write(file, of.technique, kind, strength, scene.scene, counts);
            };
            // Without random numbers there is nothing to draw: frames without a defect are identical.
            if (of.depends_on_seed()) keep("none", "no defect", gate.without_defect(runs));
            for (const Defect& defect : all_defects())
                if (gate.changes(defect))
                    keep(defect.kind, defect.strength, gate.with_defect(defect, of.depends_on_seed() ? draws : 1));
            const unsigned refused = gate.refuses_nan();
            keep("NaN", "one value of an image", {.runs = 1, .worse = {refused, refused}});
        }
    }
    fs::remove_all(folder);
    std::fclose(file);
} catch (const Error& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return 2;
}
