#include "experiments/study/measuring/costs/compiled_shaders.h"
#include "core/error.h"
#include "core/gpu/device.h"
#include "core/scene/load_scene.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/measuring/render_technique.h"
#include "experiments/study/needs.h"
#include "variants/registry.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

// What compilers of GPUs make of the techniques: no GPU is needed, but Mesa's radv.

namespace {

struct CompiledShaders : testing::Test {
    static Device& device() {
        static Device shared;
        return shared;
    }
    static GpuCompilers& compilers() {
        static GpuCompilers found = find_compilers({default_chips.begin(), default_chips.end()});
        return found;
    }
    /// Passes that techniques and points share are compiled once.
    static const std::filesystem::path& cache() {
        static const std::filesystem::path folder = std::filesystem::temp_directory_path() / "compiled_shaders_cache";
        return folder;
    }
    static void SetUpTestSuite() { std::filesystem::remove_all(cache()); }
    static void TearDownTestSuite() { std::filesystem::remove_all(cache()); }
    void SetUp() override {
        if (const std::string& why = compilers().entries.front().refusal; !why.empty()) GTEST_SKIP() << why;
    }
    /// As an engine would have the technique: nothing is left out.
    static std::vector<CompiledRow> rows_of(const PointConfig& point) {
        const Shot shot =
            load_shot({.scene = "mirror_pillars", .extent = {32, 24}, .frames = {0}, .warm_up = 1, .direct_lit = true},
                      scene_search_path({}));
        const std::unique_ptr<FrameSource> source = scene_source(device(), shot, timed_config({point}, 0), true);
        FrameStore store(*source, shot.config, 0);
        const HostImage unused;
        const StagePipelines pipelines = stage_pipelines(
            device(), shot, store, [&](const FrameStep&) -> const HostImage& { return unused; }, point, true);
        return compiled_rows(pipelines, shot.name(), point, compilers(), {.cache = cache()});
    }
    static std::optional<CompiledRow> find(const std::vector<CompiledRow>& rows, const CompiledRow& like) {
        for (const CompiledRow& row : rows)
            if (row.chip == like.chip && row.stage == like.stage && row.pipeline == like.pipeline &&
                row.shader == like.shader)
                return row;
        return {};
    }
};

}  // namespace

/// The file sizes of registers (occupancy.cpp) explain every occupancy that the compiler states.
TEST_F(CompiledShaders, NoTechniqueSpillsByDefaultAndAllOccupanciesAreExplained) {
    for (const TechniqueEntry& entry : technique_table()) {
        const std::vector<CompiledRow> rows = rows_of(single_point(entry.name));
        EXPECT_EQ(rows.empty(), entry.name == "none") << entry.name;
        for (const CompiledRow& row : rows) {
            const std::string where = row.technique + ' ' + row.stage + ' ' + row.shader + ' ' + row.chip;
            EXPECT_EQ(row.refusal, "") << where;
            EXPECT_EQ(row.spilled_vgprs, 0) << where;
            EXPECT_EQ(row.scratch_bytes, 0) << where;
            EXPECT_NE(row.limit, "") << where << ": " << row.waves.value_or(-1) << " waves of "
                                     << row.vgprs.value_or(-1) << " VGPRs";
            EXPECT_GE(row.waves, 1) << where;
        }
    }
}

/// Counts of a technique without forms for GPUs are taken once for both.
TEST(GpuForms, ATechniqueDeclaresThem) {
    Device device;
    const std::vector<PointConfig> points = {single_point("mcguire_dda"), single_point("amd_sssr"),
                                             single_point("composed_ssr"),
                                             single_point("composed_ssr", "amd_denoiser")};
    const Shot shot =
        load_shot({.scene = "mirror_pillars", .extent = {32, 24}, .frames = {0}, .warm_up = 1, .direct_lit = true},
                  scene_search_path({}));
    for (const PointConfig& point : points) {
        std::array<StagePipelines, 2> of_forms;  // for CPUs, for GPUs
        for (const bool is_gpu : {false, true}) {
            const std::unique_ptr<FrameSource> source = scene_source(device, shot, timed_config({point}, 0), true);
            FrameStore store(*source, shot.config, 0);
            const Renderer renderer(device, shot.config.extent, point);
            of_forms[is_gpu].collect_from(*renderer.pass_list);
            renderer.pass_list->use_gpu_forms(is_gpu);
            for (const FrameStep& step : shot.steps) {
                const FrameStore::Frame frame = store.frame(step, {});
                renderer.render(frame.camera, 1, frame.gbuffer);
                renderer.pass_list->times();
            }
            const auto recipe = [](const StagePipelines::Entry& entry) { return bytes_of({entry.recipe}); };
            if (!is_gpu) continue;
            EXPECT_EQ(!std::ranges::equal(of_forms[0].entries(), of_forms[1].entries(), {}, recipe, recipe),
                      renderer.technique->has_gpu_forms())
                << point.technique << ' ' << point.point;
        }
    }
}

TEST_F(CompiledShaders, AmdsDenoiserIsTheOriginalsOnGpus) {
    const std::vector<CompiledRow> on_gpu = rows_of(single_point("amd_sssr")),
                                   original = rows_of(single_point("amd_sssr", "sdk_1_5")),
                                   on_cpu = rows_of(single_point("amd_sssr", "", {{"denoiser_form", "fast"}}));
    size_t compared = 0, spilled = 0;
    for (const CompiledRow& row : on_gpu) {
        const std::optional<CompiledRow> faithful = find(original, row);
        ASSERT_TRUE(faithful) << row.stage;
        EXPECT_GE(*row.waves, 0.5 * *faithful->waves) << row.stage << ' ' << row.chip;
        if (row.stage != "amd_sssr/reproject") {  // which has a barrier more
            EXPECT_EQ(row.hash, faithful->hash) << row.stage << ' ' << row.chip;
        }
        ++compared;
    }
    for (const CompiledRow& row : on_cpu) spilled += row.spilled_vgprs.value_or(0) > 0;
    EXPECT_GT(compared, 3 * 6u);
    EXPECT_GE(spilled, 3u) << "the form for CPUs spills on each chip: else these tests see nothing";
}
