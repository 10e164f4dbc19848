// Techniques from folders in studies: their rows, their copies, and which of their cells an edit redoes.
#include "core/error.h"
#include "experiments/study/plan/study_plan.h"
#include "tests/error_message.h"
#include "tests/experiments/study/study_fixture.h"
#include "variants/registry.h"

#include <set>

namespace {

struct DeclaredStudy : StudyTest {
    /// Its name is the test's, for a process has each name for one folder.
    std::string name;
    void SetUp() override {
        StudyTest::SetUp();
        name = testing::UnitTest::GetInstance()->current_test_info()->name();
        std::ranges::transform(name, name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
        fs::create_directories(technique());
        fs::copy(fs::path(SSRLAB_SOURCE_DIR) / "variants/mcguire_dda/technique.json", technique());
        edit("technique.json", "mcguire_dda/shade.comp", "shade.comp");
        std::string shade = read_text(fs::path(SSRLAB_SOURCE_DIR) / "variants/mcguire_dda/shade.comp");
        shade += "#include \"own.glsl\"\n";
        write_text(technique() / "shade.comp", shade);
        write_text(technique() / "own.glsl", "// nothing\n");
    }
    fs::path technique() const { return folder / "techniques" / name; }
    void edit(const std::string& file, const std::string& before, const std::string& after) const {
        std::string text = read_text(technique() / file);
        ASSERT_NE(text.find(before), std::string::npos) << file;
        write_text(technique() / file, text.replace(text.find(before), before.size(), after));
    }
    Config study(const std::string& techniques) {
        write_text(folder / "study.json", R"({"shots": [{"scene": "fence", "resolution": [32, 18]}], "lit": "direct",
            "reference": {"samples": 16}, "timing": {"frames": 0}, "metrics": ["mse"], "techniques": )" +
                                              techniques + "}");
        return read_config(folder / "study.json");
    }
    std::string own() const { return "{\"technique\": \"./techniques/" + name + "\"}"; }

    /// Cells by what they are of.
    std::map<std::string, std::string> cells(const Config& config, const std::vector<SourceFile>& sources) const {
        const StudyPlan plan =
            plan_study(config, {.name = "d", .driver = "1"}, {fs::path(SSRLAB_SOURCE_DIR) / "scenes"}, false, sources);
        std::map<std::string, std::string> names;
        for (const PlannedCell& cell : plan.shots[0].cells)
            names[cell.what.substr(cell.what.find(": ") + 2)] = cell.name;
        return names;
    }
};

std::set<std::string> differing(const std::map<std::string, std::string>& a,
                                const std::map<std::string, std::string>& b) {
    std::set<std::string> whats;
    for (const auto& [what, name] : a)
        if (b.at(what) != name) whats.insert(what);
    return whats;
}

TEST_F(DeclaredStudy, RunsLikeTheTechniqueThatItIsWrittenAfter) {
    const fs::path results = run(study("[{\"technique\": \"mcguire_dda\"}, " + own() + "]"), "out");
    std::map<std::string, std::string> errors;
    std::istringstream rows(read_text(results / "results.csv"));
    for (std::string row; std::getline(rows, row);)
        for (const std::string& technique_name : {std::string("mcguire_dda"), name})
            if (const size_t at = row.find("," + technique_name + ","); at != std::string::npos)
                errors[technique_name] += row.erase(at + 1, technique_name.size()) + "\n";
    EXPECT_FALSE(errors[name].empty());
    EXPECT_EQ(errors[name], errors["mcguire_dda"]);
    const fs::path copy = results / "techniques" / name;
    for (const char* file : {"technique.json", "shade.comp", "own.glsl"})
        EXPECT_EQ(read_text(copy / file), read_text(technique() / file)) << file;
}

TEST_F(DeclaredStudy, AnEditRedoesItsCellsAndNoOthers) {
    const std::string techniques =
        R"([{"technique": "none"}, {"technique": "mcguire_dda"}, {"technique": "composed_ssr"}, )" + own() + "]";
    const std::vector<SourceFile> sources = present_sources();
    const auto before = cells(study(techniques), sources);
    const std::set<std::string> its_own = {name + " default"};
    EXPECT_EQ(differing(before, cells(study(techniques), sources)), std::set<std::string>());
    edit("own.glsl", "nothing", "something");
    const auto edited = cells(study(techniques), sources);
    EXPECT_EQ(differing(before, edited), its_own);
    edit("technique.json", "\"format\": \"r8\"", "\"format\": \"r16f\"");
    const auto declared = cells(study(techniques), sources);
    EXPECT_EQ(differing(edited, declared), its_own);
    edit("technique.json", "Screen-space", "Screen space");
    edit("technique.json", "for results as published", "as in the paper");
    write_text(technique() / "README.md", "of no shader\n");
    EXPECT_EQ(differing(declared, cells(study(techniques), sources)), std::set<std::string>());

    const auto with_edit_of = [&](const std::string& path) {
        std::vector<SourceFile> edited_sources = sources;
        std::ranges::find(edited_sources, path, &SourceFile::path)->hash += "edited";
        return differing(declared, cells(study(techniques), edited_sources));
    };
    const std::set<std::string> of_this_march = {"mcguire_dda default", name + " default"};
    std::set<std::string> all = of_this_march;
    all.insert({"none default", "composed_ssr default"});
    EXPECT_EQ(with_edit_of("variants/declared/declared_technique.cpp"), all) << "it reads every technique";
    EXPECT_EQ(with_edit_of("variants/mcguire_dda/trace.comp"), of_this_march);
    EXPECT_EQ(with_edit_of("variants/denoisers/ratio_accumulation/accumulate.comp"),
              std::set<std::string>{"composed_ssr default"});
    EXPECT_EQ(with_edit_of("variants/amd_sssr/intersect.comp"), std::set<std::string>());
}

TEST_F(DeclaredStudy, FoldersAreFoundFromTheConfigThatNamesThem) {
    study("[" + own() + "]");
    fs::create_directories(folder / "derived");
    write_text(folder / "derived/study.json",
               "{\"extends\": \"../study.json\", \"techniques\": [{\"technique\": \"../techniques/" + name +
                   "\", \"parameters\": {\"max_roughness\": 0.25}}]}");
    const Config derived = read_config(folder / "derived/study.json");
    ASSERT_EQ(derived.techniques.size(), 1u);
    EXPECT_EQ(derived.techniques[0].technique, name);
    EXPECT_EQ(derived.techniques[0].parameters.at("max_roughness"), 0.25);
    const std::string missing = error_message([&] { study("[{\"technique\": \"./nowhere\"}]"); });
    EXPECT_NE(missing.find("study.json:2:"), std::string::npos) << missing;
    EXPECT_NE(missing.find("it has no technique.json"), std::string::npos) << missing;
}

}  // namespace
