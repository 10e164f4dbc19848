// The table of metrics of sequences in metrics/coverage.md: temporal_coverage_study [REFERENCES] > rows.csv, and the
// table to standard error.
#include "core/error.h"
#include "experiments/results/verdicts/summary.h"
#include "experiments/study/measuring/frame_means.h"
#include "metrics/flicker.h"
#include "metrics/frame_difference.h"
#include "metrics/ghost.h"
#include "metrics/ghost_share.h"
#include "metrics/video_jod.h"
#include "tests/experiments/study/measuring/coverage_view.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <random>

namespace {

constexpr glm::uvec2 extent(64, 36);
constexpr unsigned samples = 64, truth_samples = 8192, known_runs = 64, seed_counts[] = {4, 8};
/// Frames before what is held, held, and after the change. Of a history of weight 0.4 the correlation is 0.6: 15 frames
/// are enough for its flicker.
constexpr unsigned warm_up = 16, held = 20, after = 24;
/// Of the video whose visibility is scored: so many frames, half of them before the change.
constexpr unsigned seen = 12;
constexpr double frames_per_second = 30;

/// Both poses are of one camera.
struct ChangingScene {
    const char* name;
    float before, after;
};
constexpr ChangingScene scenes[] = {
    {"stepping_emitter", 29, 30}, {"moving_objects", 0, 10}, {"disocclusion_moving_column", 0, 10}};

/// Techniques: fresh noise in each frame, and a history that takes in so much of it.
constexpr std::pair<const char*, float> techniques[] = {{"noisy", 1.0f}, {"history", 0.4f}};

using BothPoses = std::array<PoseTruth, 2>;

/// Frames of one run of a technique, each of noise that is drawn anew from images which were traced once.
std::vector<HostImage> run_of(const std::array<std::vector<HostImage>, 2>& noise, float weight, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<HostImage> frames;
    for (unsigned frame = 0; frame < warm_up + held + after; ++frame) {
        const std::vector<HostImage>& of_pose = noise[frame >= warm_up + held];
        HostImage shown = of_pose[random() % of_pose.size()];
        if (frame > 0)
            for (size_t i = 0; i < shown.values.size(); ++i)
                shown.values[i] = weight * shown.values[i] + (1 - weight) * frames.back().values[i];
        frames.push_back(std::move(shown));
    }
    return frames;
}

/// As PointErrors has them.
std::vector<ResultRow> rows_of(const std::vector<HostImage>& frames, const BothPoses& truth,
                               std::span<const Mask> masks, const ResultRow& shared) {
    const MetricReference &before = *truth[0].frame_reference, &now = *truth[1].frame_reference;
    FlickerMoments moments;
    for (unsigned i = warm_up; i < warm_up + held; ++i) moments.add(frames[i]);
    std::vector<TemporalScore> scores = flicker_scores(moments, &before, masks);
    const auto append = [&](const std::vector<TemporalScore>& more) {
        scores.insert(scores.end(), more.begin(), more.end());
    };
    FrameDifference difference;
    GhostShare ghosts;
    constexpr unsigned change = warm_up + held;
    for (unsigned i = change - 1; i < change + 2; ++i) {
        const MetricReference &earlier = i > change ? now : before, &later = i >= change ? now : before;
        difference.add(frames[i - 1], frames[i], earlier, later, masks);
        ghosts.add(frames[i], earlier, later, masks);
    }
    append(difference.scores());
    append(ghosts.scores());
    VideoJod video(extent, now.settings, frames_per_second);
    for (unsigned i = change - seen / 2; i < change + seen / 2; ++i) {
        const PoseTruth& pose = truth[i >= change];
        const auto image = [&](const HostImage& specular) { return sum(pose.direct, specular); };
        video.add(image(frames[i]),
                  {image(pose.frame_reference->image), image(pose.frame_reference->halves->a),
                   image(pose.frame_reference->halves->b)},
                  /*is_scored=*/true);
    }
    append({video.score()});
    for (const Ghost& ghost : ghost_scores(std::span(frames).subspan(change), before, now, masks))
        append({ghost.ghost_length, ghost.settling_length});

    std::vector<ResultRow> rows;
    const auto if_finite = [](std::optional<double> v) { return v && std::isfinite(*v) ? v : std::nullopt; };
    for (const TemporalScore& s : scores) {
        ResultRow& row = rows.emplace_back(shared);
        row.metric = s.metric->name, row.mask = s.mask, row.value = if_finite(s.value);
        row.low = if_finite(s.low), row.high = if_finite(s.high);
    }
    FrameMeans means;
    for (const bool is_after : {false, true})
        means.add(measure_frame(truth[is_after], is_after ? frames.back() : frames[change - 1], masks, shared));
    for (ResultRow& row : means.rows()) {
        row.metric = "mean of " + row.metric;
        rows.push_back(std::move(row));
    }
    return rows;
}

struct Count {
    double trials = 0, intervals = 0, covered = 0;

    double coverage() const { return covered / intervals; }
};

using Counts = std::map<std::pair<std::string, unsigned>, Count>;  // by metric and number of seeds

Counts counts_of(const ChangingScene& scene, unsigned references) {
    const View views[] = {{scene.name, extent, scene.before}, {scene.name, extent, scene.after}};
    Config config;
    config.frame_metrics = {"mse", "relmse", "flip", "ssim"};
    const auto truth_of = [&](unsigned count, unsigned seed) {
        const auto of_pose = [&](const View& view) {
            return pose_truth(view.reference(count, seed), config, 0, {.has_frame_reference = true});
        };
        return BothPoses{of_pose(views[0]), of_pose(views[1])};
    };
    std::array<std::vector<HostImage>, 2> noise;
    for (const bool is_after : {false, true})
        for (unsigned seed = 0; seed < known_runs; ++seed)
            noise[is_after].push_back(views[is_after].reference(16, 0x7e57 + seed).specular.mean);
    const std::vector<Mask> masks = surface_masks(views[0], views[0].reference(16, 0), {"all", "reflective"});
    const BothPoses exact = truth_of(truth_samples, references + 1);

    Counts counts;
    for (const auto& [technique, weight] : techniques) {
        std::vector<std::vector<HostImage>> runs;
        for (unsigned run = 0; run < known_runs; ++run) runs.push_back(run_of(noise, weight, run));
        const auto summaries = [&](const BothPoses& truth, unsigned first, unsigned count) {
            std::vector<ResultRow> rows;
            for (unsigned seed = first; seed < first + count; ++seed)
                for (ResultRow& row : rows_of(runs[seed % known_runs], truth, masks, {.seed = seed}))
                    rows.push_back(std::move(row));
            return summarise(rows);
        };
        std::map<std::pair<std::string, std::string>, double> known;
        for (const MetricSummary& s : summaries(exact, 0, known_runs))
            if (s.value) known[{s.metric, s.mask}] = *s.value;
        for (unsigned r = 0; r < references; ++r) {
            const BothPoses truth = truth_of(samples, r);
            for (const unsigned seeds : seed_counts)
                for (const MetricSummary& s : summaries(truth, r * seeds, seeds)) {
                    const auto value = known.find({s.metric, s.mask});
                    if (value == known.end()) continue;
                    Count& count = counts[{s.metric, seeds}];
                    ++count.trials;
                    if (!s.ranked || !s.low || !s.high) continue;
                    ++count.intervals, count.covered += *s.low <= value->second && value->second <= *s.high;
                    std::printf("%s,%s,%u,%s,%s,%.6g,%.6g,%.6g,%.6g\n", scene.name, technique, seeds, s.metric.c_str(),
                                s.mask.c_str(), *s.value, *s.low, *s.high, value->second);
                }
        }
    }
    return counts;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const unsigned references = argc > 1 ? unsigned(std::atoi(argv[1])) : 24;
        Counts all;
        std::map<std::pair<std::string, unsigned>, double> least;  // coverage of one scene
        std::printf("scene,technique,seeds,metric,mask,value,low,high,truth\n");
        for (const ChangingScene& scene : scenes)
            for (const auto& [key, count] : counts_of(scene, references)) {
                Count& sum = all[key];
                sum.trials += count.trials, sum.intervals += count.intervals, sum.covered += count.covered;
                if (count.intervals > 0)
                    least[key] = std::min(least.try_emplace(key, 1.0).first->second, count.coverage());
            }
        std::fprintf(stderr, "| metric | 4 seeds | 8 seeds | least of a scene, 4 | 8 |\n|---|---|---|---|---|\n");
        for (const auto& [key, four] : all) {
            if (key.second != seed_counts[0]) continue;
            const std::pair<std::string, unsigned> other(key.first, seed_counts[1]);
            const Count& eight = all.at(other);
            if (four.intervals == 0) continue;
            std::fprintf(stderr, "| `%s` | %.1f %% of %.0f %% | %.1f %% of %.0f %% | %.1f %% | %.1f %% |\n",
                         key.first.c_str(), 100 * four.coverage(), 100 * four.intervals / four.trials,
                         100 * eight.coverage(), 100 * eight.intervals / eight.trials, 100 * least[key],
                         100 * least[other]);
        }
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
