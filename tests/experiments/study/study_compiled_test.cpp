// What GPUs' compilers make of a study's passes: compiled.csv.
#include "core/files.h"
#include "experiments/gpu_costs/chips/chip_compiler.h"
#include "experiments/results/cells/cell_store.h"
#include "experiments/results/cells/estimate_table.h"
#include "tests/experiments/study/study_fixture.h"
#include "tests/gpu_costs/fake_mesa.h"

namespace {

const std::string compiled_study =
    R"({"shots": [{"scene": "mirror_pillars", "resolution": [32, 24]}], "reference": "none", "lit": "direct",
"techniques": [{"technique": "none"}, {"technique": "mcguire_dda", "sweep": {"tracer": ["dda", "exact_scene"]}}],
"timing": {"frames": 0}, "gpu_compilers": [)";

}  // namespace

TEST_F(StudyTest, CompilesForChips) {
    const auto run = [&](const std::string& chips, const std::string& before) {
        write_text(folder / "study.json", compiled_study + chips + "]}");
        const std::string command = "cd '" + folder.string() + "' && " + before + " SSRLAB_CACHE='" +
                                    (folder / "cache").string() +
                                    "' '" SSRLAB_PROGRAM "' run study.json --out compiled --replace > log 2>&1";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    const auto rows = [&] { return read_rows<CompiledRow>(folder / "compiled/compiled.csv"); };

    // Without radv the study goes on, and each stage says why it has no numbers.
    ASSERT_EQ(run("\"navi21\"",
                  "VK_DRIVER_FILES=$(ls /usr/share/vulkan/icd.d/lvp_icd*) VK_ICD_FILENAMES=$(ls "
                  "/usr/share/vulkan/icd.d/lvp_icd*)"),
              0)
        << read_text(folder / "log");
    EXPECT_NE(read_text(folder / "log").find("there is no radv"), std::string::npos) << read_text(folder / "log");
    ASSERT_EQ(rows().size(), 2u);
    for (const CompiledRow& row : rows()) {
        EXPECT_NE(row.refusal.find("mesa-vulkan-drivers"), std::string::npos);
        EXPECT_EQ(row.point, "tracer=dda") << "exact rays are no passes";
        EXPECT_FALSE(row.vgprs);
    }

    try {
        find_chip("navi21");
    } catch (const MachineError& e) {
        GTEST_SKIP() << e.what();
    }
    // What was refused is not kept for a machine that has radv.
    ASSERT_EQ(run("\"navi21\"", ""), 0) << read_text(folder / "log");
    ASSERT_EQ(rows().size(), 2u);
    EXPECT_EQ(rows()[0].refusal, "");
    // Nor is that of a compiler that was killed.
    const CellStore cells(folder / "compiled", [](const std::string& notice) { ADD_FAILURE() << notice; });
    for (const std::string& name : cells.names())
        if (Cell cell = *cells.load(name); !cell.compiled.empty() && cell.compiled[0].refusal.empty()) {
            cell.compiled[0].refusal = "radv's compiler ended: signal 9";
            cells.save(name, cell);
        }
    ASSERT_EQ(run("\"navi21\"", ""), 0) << read_text(folder / "log");
    EXPECT_NE(read_text(folder / "log").find("is asked again"), std::string::npos) << read_text(folder / "log");
    EXPECT_EQ(rows()[0].refusal, "");
    ASSERT_EQ(run("\"navi21\"", ""), 0);
    EXPECT_EQ(read_text(folder / "log").find("is asked again"), std::string::npos) << read_text(folder / "log");
    EXPECT_EQ(run("\"navi21\", \"navi2\"", ""), 2);
    EXPECT_NE(read_text(folder / "log").find("knows no chip 'navi2'; did you mean"), std::string::npos)
        << read_text(folder / "log");
    ASSERT_EQ(run("\"navi21\", \"vega10\"", ""), 0) << read_text(folder / "log");
    ASSERT_EQ(rows().size(), 4u);
    for (const CompiledRow& row : rows()) {
        EXPECT_EQ(row.refusal, "");
        EXPECT_GT(row.vgprs.value_or(0), 0);
        EXPECT_NE(row.hash, "");
    }
}

/// Another version of the compiler makes other cells, so that no table mixes both.
TEST_F(StudyTest, KeepsVersionsOfCompilersApart) {
    if (!unpack_fake_mesa(folder / "mesa")) GTEST_SKIP() << "no radv is installed";
    std::string study = compiled_study + "\"navi21\"], \"costs\": true}";
    write_text(folder / "study.json", study);
    const auto ssrlab = [&](const std::string& command, const std::string& mesa) {
        const std::string line = "cd '" + folder.string() + "' && SSRLAB_MESA='" + mesa + "' SSRLAB_CACHE='" +
                                 (folder / "cache").string() + "' '" SSRLAB_PROGRAM "' " + command + " > log 2>&1";
        const int status = std::system(line.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    const auto expect_mesa_99 = [&](const std::string& out, bool is_99) {
        const std::vector<CompiledRow> compiled = read_rows<CompiledRow>(folder / out / "compiled.csv");
        const std::vector<EstimateTableRow> estimates = read_rows<EstimateTableRow>(folder / out / "estimates.csv");
        ASSERT_FALSE(compiled.empty() || estimates.empty());
        for (const CompiledRow& row : compiled) EXPECT_EQ(row.driver.starts_with("radv Mesa 99"), is_99) << row.driver;
        for (const EstimateTableRow& row : estimates)
            EXPECT_EQ(row.driver.starts_with("radv Mesa 99"), is_99) << row.driver;
    };
    ASSERT_EQ(ssrlab("run study.json --out one", ""), 0) << read_text(folder / "log");
    expect_mesa_99("one", false);
    ASSERT_EQ(ssrlab("run study.json --out one", "mesa"), 0) << read_text(folder / "log");
    expect_mesa_99("one", true);
    ASSERT_EQ(ssrlab("run study.json --out two", ""), 0) << read_text(folder / "log");
    ASSERT_EQ(ssrlab("merge study.json two --out merged", ""), 0) << read_text(folder / "log");
    expect_mesa_99("merged", false);
    EXPECT_NE(ssrlab("merge study.json two --out other", "mesa"), 0) << "its cells are of the other version";
    EXPECT_EQ(ssrlab("run study.json --out three", "nowhere"), 2);
    EXPECT_NE(read_text(folder / "log").find("'nowhere', does not exist"), std::string::npos)
        << read_text(folder / "log");
}
