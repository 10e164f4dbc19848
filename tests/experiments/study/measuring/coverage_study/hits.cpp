// How often the intervals of hits.csv hold the mean over many seeds: hit_coverage_study [SEEDS [SCENE...]] > rows.csv,
// and the table of metrics/coverage.md to standard error.
#include "core/error.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gbuffer/rasterizer.h"
#include "core/gpu/device.h"
#include "core/scene/load_scene.h"
#include "experiments/study/measuring/rays/exact_rays.h"
#include "experiments/study/measuring/rays/judged_hits.h"
#include "experiments/study/measuring/render_technique.h"
#include "variants/registry.h"

#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <tuple>

namespace {

constexpr glm::uvec2 extent(128, 72);
constexpr unsigned seed_counts[] = {2, 4, 8};

struct Technique {
    const char *technique, *preset;
};
constexpr Technique techniques[] = {
    {"amd_sssr", "corrected"}, {"diligent_ssr", "corrected"}, {"frostbite_sssr", "frostbite_2015"}};
const std::vector<std::string> default_scenes = {"roughness_gradient", "fence", "glossy_stretch", "floating_holes"};

/// All pixels, classes of roughness, and a few pixels at random, whose counts are small.
std::vector<Mask> masks_of(const HostImage& normal_and_roughness) {
    std::vector<Mask> masks = {{.name = "all"}};
    const auto add = [&](const std::string& name, const auto& is_inside) {
        Mask mask{.name = name, .extent = extent, .inside = std::vector<uint8_t>(extent.x * extent.y)};
        for (unsigned pixel = 0; pixel < extent.x * extent.y; ++pixel) mask.inside[pixel] = is_inside(pixel);
        masks.push_back(std::move(mask));
    };
    const auto roughness = [&](unsigned pixel) { return normal_and_roughness.values[4 * pixel + 3]; };
    add("roughness_0_0.1", [&](unsigned pixel) { return roughness(pixel) < 0.1f; });
    add("roughness_0.1_0.3", [&](unsigned pixel) { return roughness(pixel) >= 0.1f && roughness(pixel) < 0.3f; });
    add("roughness_0.3_1", [&](unsigned pixel) { return roughness(pixel) >= 0.3f; });
    for (const unsigned share : {10u, 100u}) {
        std::mt19937 random(share);
        add("one pixel in " + std::to_string(share), [&](unsigned) { return random() % share == 0; });
    }
    return masks;
}

using Key = std::tuple<std::string, std::string, std::string>;  // stage, mask, quantity
struct Interval {
    unsigned seeds;
    Key key;
    double low, high;
};
struct Count {
    double intervals = 0, covered = 0;
};

}  // namespace

int main(int argc, char** argv) {
    try {
        const unsigned seeds = argc > 1 ? unsigned(std::atoi(argv[1])) / 8 * 8 : 240;
        Device device;
        std::map<std::string, std::map<unsigned, Count>> by_mask, by_quantity;
        std::printf("scene,technique,stage,mask,quantity,seeds,intervals,covered,truth,rays\n");
        const std::vector<std::string> scenes =
            argc > 2 ? std::vector<std::string>(argv + 2, argv + argc) : default_scenes;
        for (const std::string& scene : scenes) {
            const Shot shot = load_shot({.scene = scene, .extent = extent}, scene_search_path());
            Rasterizer rasterizer(device, shot.scene, {.extent = extent});
            GBuffer gbuffer = rasterizer.render(shot.camera, {.extent = extent});
            rasterizer.light_directly(gbuffer);
            const std::vector<Mask> masks = masks_of(rasterizer.pass_list().download(gbuffer.normal));
            ExactRays exact(shot, 0, rasterizer.camera());
            for (const Technique& technique : techniques) {
                const auto technique = make_technique(technique.technique, {}, technique.preset);
                PassList pass_list(device, extent);
                RayProbe probe;
                probe.is_recording = true;
                technique->ray_probe = &probe;
                JudgedHits of_all;
                std::map<unsigned, JudgedHits> of_batch;
                std::vector<Interval> intervals;
                for (unsigned seed = 0; seed < seeds; ++seed) {
                    render_technique(pass_list, *technique, rasterizer.camera(), seed, gbuffer);
                    for (const RecordedRays& recorded : probe.recorded) {
                        const std::vector<ExactHit> truth = exact.hits(recorded);
                        of_all.add(seed, recorded, truth, extent, 1, masks);
                        for (const unsigned count : seed_counts)
                            of_batch[count].add(seed, recorded, truth, extent, 1, masks);
                    }
                    probe.recorded.clear();
                    for (const unsigned count : seed_counts) {
                        if ((seed + 1) % count != 0) continue;
                        for (const HitRow& row : of_batch[count].rows({}))
                            if (row.low)
                                intervals.push_back({count, {row.stage, row.mask, row.quantity}, *row.low, *row.high});
                        of_batch[count] = {};
                    }
                }
                std::map<Key, HitRow> truth;
                for (const HitRow& row : of_all.rows({})) truth[{row.stage, row.mask, row.quantity}] = row;
                std::map<std::pair<Key, unsigned>, Count> counts;
                for (const Interval& i : intervals) {
                    Count& count = counts[{i.key, i.seeds}];
                    // What rounding of sums makes of a number that all seeds agree on.
                    const double mean = truth.at(i.key).value, rounding = 1e-12 * (1 + std::abs(mean));
                    ++count.intervals, count.covered += i.low - rounding <= mean && mean <= i.high + rounding;
                }
                for (const auto& [key, count] : counts) {
                    const auto& [stage, mask, quantity] = key.first;
                    std::printf("%s,%s %s,%s,%s,%s,%u,%.0f,%.0f,%.6g,%.1f\n", scene.c_str(), technique.technique,
                                technique.preset, stage.c_str(), mask.c_str(), quantity.c_str(), key.second,
                                count.intervals, count.covered, truth.at(key.first).value, truth.at(key.first).rays);
                    for (Count* sum : {&by_mask[mask][key.second], &by_quantity[quantity][key.second]})
                        sum->intervals += count.intervals, sum->covered += count.covered;
                }
                std::fflush(stdout);
            }
        }
        std::fprintf(stderr, "| | 2 seeds | 4 | 8 |\n|---|---|---|---|\n");
        for (const auto* lines : {&by_mask, &by_quantity})
            for (const auto& [name, line] : *lines) {
                std::fprintf(stderr, "| `%s` |", name.c_str());
                for (const unsigned count : seed_counts) {
                    const auto sum = line.find(count);
                    if (sum == line.end())
                        std::fprintf(stderr, " none |");
                    else
                        std::fprintf(stderr, " %.1f %% |", 100 * sum->second.covered / sum->second.intervals);
                }
                std::fprintf(stderr, "\n");
            }
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
