// How often `ssrlab judge` is wrong, on the noise of real techniques: of two groups of frames that differ by chance
// alone it must call at most 1 % worse or better, and where one has 1.05 times the error it must see at least 95 %.
// Groups are drawn from frames that were measured once, as a folder of another program's images.
//
//     judge_study [RUNS [WIDTH HEIGHT]]      # a row of Markdown for each scene and technique
#include "core/error.h"
#include "experiments/results/cells/cell_store.h"
#include "experiments/results/cells/study_rows.h"
#include "experiments/results/verdicts/judgement.h"
#include "experiments/study/config/comparisons.h"
#include "tests/experiments/study/external_fixture.h"

#include <unistd.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>

namespace {

constexpr unsigned pool_size = 64, seeds = 8;
constexpr double larger = 1.05;

struct Case {
    const char *scene, *technique;
};
constexpr Case cases[] = {
    {"mirror_pillars", "frostbite_sssr"}, {"roughness_gradient", "frostbite_sssr"}, {"roughness_gradient", "amd_sssr"}};

/// Every frame of a technique, measured as it is (point "as_is") and with its error enlarged (point "larger").
class MeasuredPool {
public:
    MeasuredPool(const Case& c, glm::uvec2 extent) : case_(c), extent_(extent) {
        folder_ = fs::temp_directory_path() / ("ssrlab-judge-study-" + std::to_string(getpid()));
        fs::remove_all(folder_);
        for (const char* name : {"as_is", "larger"})
            describe_frames(folder_ / name, R"(, "seeds": )" + std::to_string(pool_size));
        for (unsigned seed = 0; seed < pool_size; ++seed) write(seed, render(seed));
        run(R"({"external": "as_is", "point": "as_is"}, {"external": "larger", "point": "larger"})", "measured");
        const CellStore store(folder_ / "measured", [](const std::string&) {});
        std::vector<Cell> cells;
        for (const std::string& name : store.names())
            if (std::optional<Cell> cell = store.read(name)) cells.push_back(std::move(*cell));
        rows_ = rows_of(cells);
    }
    ~MeasuredPool() { fs::remove_all(folder_); }

    /// Of frames whose point is `point` against frames as they are.
    std::string judge(const std::string& point, std::span<const unsigned> frames,
                      std::span<const unsigned> before) const {
        const std::vector<PointConfig> techniques = {side("frames", false), side("before", true)};
        MeasuredRows chosen;
        take(point, frames, "frames", chosen), take("as_is", before, "before", chosen);
        std::vector<EffectRow> effects =
            paired_effects(chosen.results, compared_points(techniques), {}, chosen.reference_noise);
        set_verdicts(effects, {});
        return judge_effects(effects, {}, {"three_ssr", "frames"}, {"three_ssr", "before"}).verdict;
    }

    /// Standard deviation of one frame's error over the mean of all.
    double deviation() const {
        double sum = 0, squares = 0;
        for (const ResultRow& row : rows_.results)
            if (row.point == "as_is" && row.metric == "mse" && row.mask == "reflective" && row.target == "specular")
                sum += *row.value, squares += *row.value * *row.value;
        const double mean = sum / pool_size;
        return std::sqrt((squares - sum * mean) / (pool_size - 1)) / mean;
    }

private:
    static PointConfig side(const std::string& point, bool is_baseline) {
        PointConfig v{.technique = "three_ssr", .preset = "", .parameters = {}, .swept = {}, .point = point};
        v.seeds.resize(seeds), v.is_baseline = is_baseline;
        std::iota(v.seeds.begin(), v.seeds.end(), 0u);
        return v;
    }

    /// Adds the rows of `frames`, as seeds 0, 1, ... of the point `as`.
    void take(const std::string& point, std::span<const unsigned> frames, const std::string& as,
              MeasuredRows& chosen) const {
        for (unsigned seed = 0; seed < seeds; ++seed)
            for (const ResultRow& row : rows_.results)
                if (row.point == point && row.seed == frames[seed] && row.metric == "mse") {
                    chosen.results.push_back(row);
                    chosen.results.back().point = as, chosen.results.back().seed = seed;
                }
        for (const ReferenceNoise& noise : rows_.reference_noise)
            if (noise.point == point) {
                chosen.reference_noise.push_back(noise);
                chosen.reference_noise.back().point = as;
            }
    }

    fs::path run(const std::string& techniques, const std::string& out) {
        char shot[200];
        std::snprintf(shot, sizeof shot, R"({"scene": "%s", "resolution": [%u, %u], "warm_up": 4})", case_.scene,
                      extent_.x, extent_.y);
        write_text(folder_ / "study.json", R"({"shots": [)" + std::string(shot) +
                                               R"(], "reference": {"samples": 256}, "metrics": "mse",
            "targets": ["specular", "image"], "timing": {"frames": 0}, "techniques": [)" +
                                               techniques + "]}");
        run_study(read_config(folder_ / "study.json"), {.out = folder_ / out,
                                                        .cache = folder_ / "cache",
                                                        .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                                                        .replaces = true});
        return folder_ / out;
    }

    RenderedFrame render(unsigned seed) {
        const fs::path out =
            run(R"({"technique": ")" + std::string(case_.technique) + R"(", "seeds": [)" + std::to_string(seed) + "]}",
                "own");
        if (truth_.values.empty()) {
            const nlohmann::json manifest = read_json(out / "manifest.json");
            for (const nlohmann::json& entry : manifest["images"])
                if (entry["kind"] == "reference" && entry["target"] == "specular")
                    truth_ = read_exr_rgb(out / entry["exr"].get<std::string>());
        }
        return rendered_frame(out, case_.technique);
    }

    void write(unsigned seed, const RenderedFrame& frame) {
        char view[200];
        std::snprintf(view, sizeof view, "%s.main.%ux%u", case_.scene, extent_.x, extent_.y);
        if (off_.values.empty()) off_ = frame.without_reflections();
        for (const bool is_larger : {false, true}) {
            const fs::path folder = folder_ / (is_larger ? "larger" : "as_is") / view;
            const auto factor = float(std::sqrt(is_larger ? larger : 1.0));
            HostImage image = off_;
            for (size_t i = 0; i < image.values.size(); ++i)
                image.values[i] += truth_.values[i] + factor * (frame.specular.values[i] - truth_.values[i]);
            write_exr(folder / ("f0.s" + std::to_string(seed) + ".exr"), image);
            if (seed == 0) write_exr(folder / "f0.off.exr", off_);
        }
    }

    const Case& case_;
    glm::uvec2 extent_;
    fs::path folder_;
    HostImage truth_, off_;
    MeasuredRows rows_;
};

void judge_case(const Case& c, unsigned runs, glm::uvec2 extent) {
    const MeasuredPool pool(c, extent);
    std::mt19937 random(7);
    std::vector<unsigned> order(pool_size);
    std::iota(order.begin(), order.end(), 0u);
    unsigned worse = 0, better = 0, seen = 0;
    for (unsigned run = 0; run < runs; ++run) {
        std::shuffle(order.begin(), order.end(), random);
        const std::span<const unsigned> frames(order.data(), seeds), before(order.data() + seeds, seeds);
        const std::string verdict = pool.judge("as_is", frames, before);
        worse += verdict == judgement::worse, better += verdict == judgement::better;
        seen += pool.judge("larger", frames, before) == judgement::worse;
    }
    std::printf("| `%s` | `%s` | %ux%u | %.1f %% | %u, %u of %u | %u of %u |\n", c.scene, c.technique, extent.x,
                extent.y, 100 * pool.deviation(), worse, better, runs, seen, runs);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
    const unsigned runs = argc > 1 ? unsigned(std::atoi(argv[1])) : 200;
    const glm::uvec2 extent =
        argc > 3 ? glm::uvec2(unsigned(std::atoi(argv[2])), unsigned(std::atoi(argv[3]))) : glm::uvec2(480, 270);
    std::printf(
        "| Scene | Frames of | Size | deviation of an image's error | false \"worse\", \"better\" | 1.05 times the "
        "error seen "
        "|\n|---|---|---|---|---|---|\n");
    for (const Case& c : cases) judge_case(c, runs, extent);
} catch (const Error& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return 2;
}
