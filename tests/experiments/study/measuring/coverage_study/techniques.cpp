// The table of metrics/coverage.md over scenes and rooms: technique_coverage_study [SCENE...] > rows.csv, and the table
// to standard error. Real techniques against references of 64 and of 256 samples.
#include "core/error.h"
#include "tests/experiments/study/measuring/coverage_study/rendered_techniques.h"
#include "tests/experiments/study/measuring/coverage_view.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>

namespace {

constexpr glm::uvec2 extent(64, 36);
constexpr unsigned technique_seeds = 4;

struct StudiedScene {
    std::string name;
    bool is_room = false;  ///< or street: with a reflection probe
};
const std::vector<StudiedScene> all_scenes = {
    {"mirror_pillars"}, {"roughness_gradient"}, {"fence"},        {"firefly"},          {"glossy_stretch"},
    {"curved_metal"},   {"dark_room", true},    {"room:3", true}, {"room:10103", true}, {"street:2", true}};

struct References {
    unsigned samples, count;
};
constexpr References reference_sets[] = {{64, 48}, {256, 24}};

/// The truth: all of these references together. One part in 144 of it is of each reference of 64 samples, and one in 36
/// of those of 256, by which an error against it is 0.3 and 1.4 % less.
Reference truth_of(const std::vector<std::vector<Reference>>& sets) {
    double total = 0;
    for (const References& set : reference_sets) total += set.samples * set.count;
    Reference truth = sets.front().front();
    const auto outputs = [](Reference& r) { return std::array{&r.image, &r.diffuse, &r.specular, &r.incident}; };
    const auto images = [](ReferenceOutput& o) { return std::array{&o.mean, &o.half_a, &o.half_b, &o.variance}; };
    for (ReferenceOutput* output : outputs(truth))
        for (HostImage* image : images(*output)) *image = HostImage(truth.extent, 3);
    for (size_t s = 0; s < sets.size(); ++s)
        for (Reference reference : sets[s]) {
            const double share = reference_sets[s].samples / total;
            for (size_t o = 0; o < outputs(truth).size(); ++o)
                for (size_t i = 0; i < 4; ++i) {
                    const double weight = i < 3 ? share : share * share;  // of a variance
                    HostImage& sum = *images(*outputs(truth)[o])[i];
                    const HostImage& part = *images(*outputs(reference)[o])[i];
                    for (size_t v = 0; v < sum.values.size(); ++v) sum.values[v] += float(weight * part.values[v]);
                }
        }
    return truth;
}

struct Count {
    double trials = 0, intervals = 0, covered = 0;

    void add(const CoverageRow& r) { trials += r.trials, intervals += r.intervals, covered += r.covered; }
};

std::string shown(const Count& c) {
    char text[64];
    if (c.intervals < 0.005 * c.trials || c.trials == 0)
        std::snprintf(text, sizeof text, "none");
    else
        std::snprintf(text, sizeof text, "%.1f %% of %.0f %%", 100 * c.covered / c.intervals,
                      100 * c.intervals / c.trials);
    return text;
}

/// Counts of one metric and number of samples, by scene.
using OfScenes = std::map<std::string, Count>;

std::string cells(const OfScenes& of_scenes) {
    Count places[2];
    std::string worst = "none";
    double least = 2;
    for (const StudiedScene& scene : all_scenes) {
        const auto found = of_scenes.find(scene.name);
        if (found == of_scenes.end()) continue;
        const Count& c = found->second;
        Count& place = places[scene.is_room];
        place.trials += c.trials, place.intervals += c.intervals, place.covered += c.covered;
        // Too few intervals tell no coverage.
        if (c.intervals < 20 || c.covered / c.intervals >= least) continue;
        least = c.covered / c.intervals;
        char text[96];
        std::snprintf(text, sizeof text, "%s %.0f %%", scene.name.c_str(), 100 * least);
        worst = text;
    }
    return shown(places[false]) + " | " + shown(places[true]) + " | " + worst;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::set<std::string> asked(argv + 1, argv + argc);
        std::map<std::string, std::map<unsigned, OfScenes>> table;
        std::printf("scene,samples,test,target,mask,metric,trials,intervals,coverage,truth,mean,half_width\n");
        for (const StudiedScene& scene : all_scenes) {
            if (!asked.empty() && !asked.contains(scene.name)) continue;
            const View view(scene.name, extent, 0, false), with_ladder(scene.name, extent);
            std::vector<std::vector<Reference>> sets;
            unsigned seed = 0;
            for (const References& set : reference_sets) {
                std::vector<Reference>& made = sets.emplace_back();
                for (unsigned i = 0; i < set.count; ++i) made.push_back(view.reference(set.samples, seed++));
            }
            const Reference truth = truth_of(sets);
            const Techniques techniques = rendered_techniques(scene.name, extent, scene.is_room, truth, most_seeds);
            const std::vector<Mask> masks =
                surface_masks(with_ladder, with_ladder.reference(batch_count, 0), {"all", "reflective"});
            for (size_t s = 0; s < sets.size(); ++s) {
                const CoverageSetting setting{.scene = scene.name,
                                              .extent = extent,
                                              .samples = reference_sets[s].samples,
                                              .seeds = reference_sets[s].count,
                                              .targets = {"specular"},
                                              .metrics = {"mse", "relmse", "bias", "flip", "ssim", "mae", "smape",
                                                          "psnr", "outliers", "relmse_trimmed", "cvvdp_0_5_6"}};
                for (const CoverageRow& r :
                     technique_coverage(setting, techniques, masks, truth, sets[s], technique_seeds)) {
                    std::printf("%s,%u,%s,%s,%s,%s,%.0f,%.0f,%.4f,%.6g,%.6g,%.4g\n", scene.name.c_str(), r.samples,
                                r.test.c_str(), r.target.c_str(), r.mask.c_str(), r.metric.c_str(), r.trials,
                                r.intervals, r.coverage(), r.truth, r.mean, r.half_width);
                    table[r.metric][r.samples][scene.name].add(r);
                }
            }
            std::fflush(stdout);
        }
        std::fprintf(stderr,
                     "| metric | scenes, 64 samples | rooms | worst | scenes, 256 samples | rooms | worst |\n"
                     "|---|---|---|---|---|---|---|\n");
        for (const auto& [metric, by_samples] : table)
            std::fprintf(stderr, "| `%s` | %s | %s |\n", metric.c_str(), cells(by_samples.at(64)).c_str(),
                         cells(by_samples.at(256)).c_str());
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
