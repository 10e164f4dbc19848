// Which cells a study has, what each of them depends on, and which of them a process does.
#include "core/error.h"
#include "experiments/study/plan/cell_selection.h"
#include "tests/experiments/study/study_fixture.h"

#include <algorithm>
#include <map>
#include <set>

namespace {

/// A study whose cells depend on different parts of ssrlab.
struct StudyPlanTest : StudyTest {
    Config study;
    void SetUp() override {
        StudyTest::SetUp();
        write_text(folder / "study.json",
                   R"({"shots": [{"scene": ["mirror_pillars", "fence"], "resolution": [16, 9]}], "seeds": 2,
"techniques": [{"technique": "none"}, {"technique": "mcguire_dda", "sweep": {"tracer": ["dda", "hierarchy"]}},
{"technique": "amd_sssr"}]})");
        study = read_config(folder / "study.json");
    }
    StudyPlan plan(std::vector<SourceFile> sources = present_sources()) const {
        return plan_study(study, {.name = "d", .driver = "1"}, {fs::path(SSRLAB_SOURCE_DIR) / "scenes"}, false,
                          std::move(sources));
    }
    std::map<std::string, std::string> names(const StudyPlan& plan) const {
        std::map<std::string, std::string> names;
        for (const PlannedShot& shot : plan.shots)
            for (const PlannedCell& cell : shot.cells) names[cell.what] = cell.name;
        return names;
    }
};

/// A source tree of its own, in which files can be edited.
struct EditedTree {
    fs::path root;
    explicit EditedTree(fs::path folder) : root(std::move(folder)) {
        fs::create_directories(root);
        for (const char* part : {"core", "experiments", "groundtruth", "metrics", "variants"})
            fs::copy(fs::path(SSRLAB_SOURCE_DIR) / part, root / part, fs::copy_options::recursive);
    }
    /// The sources with a comment at the end of one file, which then goes again.
    std::vector<SourceFile> with_edit_of(const std::string& file) const {
        const std::string text = read_text(root / file);
        write_text(root / file, text + "\n// edited\n");
        std::vector<SourceFile> sources = read_sources(root);
        write_text(root / file, text);
        return sources;
    }
};

}  // namespace

TEST_F(StudyPlanTest, AnEditRedoesTheCellsThatItMayChange) {
    const EditedTree tree(folder / "tree");
    study.shots.pop_back();
    const auto before = names(plan(read_sources(tree.root)));
    EXPECT_EQ(before.size(), 1u + 4 + 1);
    const auto changed = [&](const std::string& file) {
        std::set<std::string> whats;
        for (const auto& [what, name] : names(plan(tree.with_edit_of(file))))
            if (before.at(what) != name) whats.insert(what.substr(what.find(": ") + 2));
        return whats;
    };
    using Cells = std::set<std::string>;
    const std::string dda = "mcguire_dda tracer=dda", hierarchy = "mcguire_dda tracer=hierarchy";
    const Cells renders = {"none default", dda, hierarchy, "amd_sssr default"};
    Cells all = renders, all_but_references = renders;
    all.insert({"references", "times"}), all_but_references.insert("times");

    for (const char* file :
         {"experiments/report/report.cpp", "experiments/page/report.js", "experiments/results/verdicts/summary.cpp",
          "experiments/results/verdicts/effects/effects.cpp", "experiments/study/manifest_entries.cpp",
          "experiments/cli/commands.h", "experiments/python/ssrlab/tables/__main__.py",
          "experiments/study/write_results.cpp", "experiments/study/progress.cpp",
          "experiments/study/config/config.cpp", "experiments/study/stability/stability.cpp", "variants/README.md"})
        EXPECT_EQ(changed(file), Cells()) << file;
    for (const char* file : {"variants/amd_sssr/intersect.comp", "variants/amd_sssr/lists.glsl"})
        EXPECT_EQ(changed(file), Cells({"amd_sssr default", "times"})) << file;
    EXPECT_EQ(changed("variants/tracers/dda/dda.glsl"), Cells({dda, "times"}));
    EXPECT_EQ(changed("variants/mcguire_dda/shade.comp"), Cells({dda, hierarchy, "times"}));
    EXPECT_EQ(changed("experiments/study/measuring/times/timing.cpp"), Cells({"times"}));
    EXPECT_EQ(changed("experiments/study/measuring/rays/judged_hits.cpp"), renders);
    for (const char* file :
         {"core/gpu/passes/frame.cpp", "core/shaders/gbuffer/background.frag", "core/scene/gltf/gltf_mesh.cpp",
          "core/gpu/pipelines/shader.cpp", "groundtruth/paths/path_tracer.cpp", "metrics/flip.cpp",
          "experiments/study/measuring/shot_truth.cpp", "experiments/results/files/targets.cpp"})
        EXPECT_EQ(changed(file), all) << file;
    EXPECT_THROW(SourceCode(read_sources(tree.root)).needed_by({"variants/frostbyte_sssr/"}), Error);
}

TEST_F(StudyPlanTest, TheProgramKnowsItsSources) {
    // What was compiled in is what lies in the tree: this test was built from it.
    const std::vector<SourceFile> compiled = present_sources(), now = read_sources(SSRLAB_SOURCE_DIR);
    for (const SourceFile& source : now) {
        const auto found = std::ranges::find(compiled, source.path, &SourceFile::path);
        ASSERT_NE(found, compiled.end()) << source.path;
        EXPECT_TRUE(found->hash.starts_with(source.hash)) << source.path;
        EXPECT_EQ(found->includes, source.includes) << source.path;
    }
}

TEST_F(StudyPlanTest, CellsAreNamedByWhatIsAskedFor) {
    const auto before = names(plan());
    std::set<std::string> distinct;
    for (const auto& [what, name] : before) EXPECT_TRUE(distinct.insert(name).second) << what;
    study.techniques[3].seeds = {4, 5};
    size_t changed = 0;
    for (const auto& [what, name] : names(plan())) changed += before.at(what) != name;
    EXPECT_EQ(changed, 2u * 2) << "the point with other seeds, and the times, which are of its first";
    study.timing.has_copies = false;
    changed = 0;
    for (const auto& [what, name] : names(plan())) changed += before.at(what) != name;
    EXPECT_EQ(changed, 2u * 2) << "times of points alone have no noise floor";
    study.reference.max_samples = 999;
    for (const auto& [what, name] : names(plan())) EXPECT_NE(before.at(what), name) << what;
}

TEST_F(StudyPlanTest, SelectionsShareTheCells) {
    const StudyPlan all = plan();
    const auto count = [&](const std::vector<std::string>& terms) {
        const CellSelection selection(terms);
        size_t cells = 0;
        for (const PlannedShot& shot : all.shots)
            cells += size_t(std::ranges::count_if(shot.cells, [&](const auto& cell) { return selection.holds(cell); }));
        return cells;
    };
    EXPECT_EQ(count({}), 12u);
    EXPECT_EQ(count({"references"}), 2u);
    EXPECT_EQ(count({"references", "times"}), 4u);
    EXPECT_EQ(count({"renders", "shot=fence.*"}), 4u);
    EXPECT_EQ(count({"shot=*nce*16x9"}), 6u);
    EXPECT_EQ(count({"technique=mcguire_dda", "shot=mirror*"}), 2u);
    EXPECT_EQ(count({"shard=1/3"}) + count({"shard=2/3"}) + count({"shard=3/3"}), 12u);
    EXPECT_LT(count({"shard=1/3"}), 12u);
    EXPECT_EQ(count({"shard=1/3", "shard=2/3", "shard=3/3"}), 12u);
    EXPECT_EQ(count({"cell=" + all.shots[0].cells[1].name.substr(0, 10)}), 1u);
    for (const char* mistake : {"render", "shard=0/3", "shard=4/3", "shard=1", "shard=1/2x", "cell=", "=", ""})
        EXPECT_THROW(CellSelection({mistake}), Error) << mistake;
}
