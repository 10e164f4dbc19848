// Results folders of strangers: nothing outside them is reached, and what their cells hold is checked where it is read.
#include "core/error.h"
#include "core/json.h"
#include "experiments/report/report.h"
#include "experiments/results/cells/cell_store.h"
#include "experiments/results/cells/image_path.h"
#include "experiments/study/measuring/times/timing.h"
#include "tests/error_message.h"
#include "tests/experiments/study/study_fixture.h"

#include <algorithm>
#include <set>

namespace {

struct HostileFolder : StudyTest {
    const fs::path outside = folder / "outside", victim = outside / "victim.exr";
    const std::string whole = "the user's own";

    void SetUp() override {
        StudyTest::SetUp();
        write_text(victim, whole);
    }
    Config small() {
        write_text(
            folder / "study.json",
            R"({"shots": [{"scene": "sky_only", "resolution": [16, 9]}], "reference": {"samples": 16}, "seeds": 2,
            "techniques": [{"technique": "none"}, {"technique": "mcguire_dda"}], "timing": {"frames": 0}, "metrics": ["mse"]})");
        return read_config(folder / "study.json");
    }
    RunSettings into(const std::string& out) {
        return {.out = folder / out,
                .device = "",
                .cache = folder / "cache",
                .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                .write_report = write_page};
    }
    std::string merging(const std::string& part, const std::string& out) {
        return error_message([&] { merge_study(small(), into(out), {folder / part}); });
    }
    /// The first image of one of its cells is this file, of which the cell knows the hash.
    void name_image(const std::string& out, const std::string& file) {
        const CellStore store(folder / out, [](const std::string&) {});
        for (const std::string& name : store.names()) {
            Cell cell = *store.read(name);
            if (cell.images.empty()) continue;
            cell.images[0]["exr"] = file, cell.images[0]["exr_hash"] = file_hash(folder / out / file);
            return store.save(name, cell);
        }
    }
};

/// What stands for a value in place of `value`: of each other type.
std::vector<nlohmann::json> others(const nlohmann::json& value) {
    std::vector<nlohmann::json> list;
    for (const nlohmann::json& other :
         {nlohmann::json("x"), nlohmann::json(-1.5), nlohmann::json(true), nlohmann::json(nullptr),
          nlohmann::json::array({{{"x", 1}}}), nlohmann::json({{"x", nlohmann::json::array({1})}})})
        if (other.type() != value.type()) list.push_back(other);
    if (value.is_number_unsigned()) list.push_back(-2);
    return list;
}

/// The places of all values but those of later elements of arrays, which are like the first.
void collect(const nlohmann::json& value, const nlohmann::json::json_pointer& place,
             std::vector<nlohmann::json::json_pointer>& places) {
    if (!place.empty()) places.push_back(place);
    if (value.is_array() && !value.empty()) collect(value[0], place / 0, places);
    if (value.is_object())
        for (const auto& [key, member] : value.items()) collect(member, place / key, places);
}

}  // namespace

TEST_F(HostileFolder, MergeReplacesAndRemovesNothingOutside) {
    run(small(), "clean");
    for (const std::string& file :
         {victim.string(), std::string("images/../../outside/victim.exr"), std::string("images/x/victim.exr"),
          std::string("images/x/../victim.exr"), std::string("study.json")}) {
        fs::remove_all(folder / "part"), fs::remove_all(folder / "merged");
        fs::copy(folder / "clean", folder / "part", fs::copy_options::recursive);
        fs::create_directory_symlink(outside, folder / "part/images/x");
        name_image("part", file);
        const std::string said = merging("part", "merged");
        EXPECT_NE(said.find("images[0]: exr: "), std::string::npos) << file << ": " << said;
        EXPECT_NE(said.find("part/cells/"), std::string::npos) << "the file is named: " << said;
        EXPECT_EQ(read_text(victim), whole) << file;
        EXPECT_FALSE(fs::is_symlink(folder / "merged/study.json"));
    }
    for (const std::string name : {"cells", "images"}) {  // of the folder that is merged into
        fs::remove_all(folder / "merged");
        fs::create_directories(folder / "merged");
        fs::create_directory_symlink(outside, folder / "merged" / name);
        EXPECT_NE(merging("clean", "merged").find("merged/" + name + " is a symbolic link"), std::string::npos);
        EXPECT_EQ(std::distance(fs::directory_iterator(outside), {}), 1) << "nothing new in there";
    }
}

TEST_F(HostileFolder, ARunWritesAndPrunesNothingOutside) {
    Config study = small();
    const fs::path out = run(study, "a");
    const auto after = [&](bool prunes) {
        RunSettings settings = into("a");
        settings.prunes = prunes;
        return error_message([&] { run_study(study, settings); });
    };
    // An image of an earlier version of the study, by what the folder says of itself.
    nlohmann::json manifest = read_json(out / "manifest.json");
    manifest["images"] = {{{"exr", "images/old/victim.exr"}, {"png", "images/../../outside/victim.exr"}},
                          {{"exr", victim.string()}, {"png", "study.json"}}};
    write_text(out / "manifest.json", manifest.dump());
    fs::create_directory_symlink(outside, out / "images/old");
    EXPECT_EQ(after(true), "no error");
    EXPECT_EQ(read_text(victim), whole);
    EXPECT_TRUE(fs::exists(out / "study.json"));

    const std::string shot = manifest["shots"][0]["shot"];
    fs::remove_all(out / "images" / shot);
    fs::create_directory_symlink(outside, out / "images" / shot);
    EXPECT_NE(after(false).find(shot + " is a symbolic link"), std::string::npos);
    fs::remove_all(out / "images"), fs::remove_all(out / "cells");
    fs::create_directory_symlink(outside, out / "cells");
    EXPECT_NE(after(false).find("cells is a symbolic link"), std::string::npos);
    EXPECT_EQ(std::distance(fs::directory_iterator(outside), {}), 1) << "nothing new in there";
}

TEST_F(HostileFolder, WrongTypesInCellsAreNamed) {
    write_text(folder / "study.json",
               R"({"shots": [{"scene": "fence", "resolution": [16, 12]}], "reference": {"samples": 16}, "seeds": 2,
        "techniques": [{"technique": "mcguire_dda"}], "timing": {"frames": 0}, "hits": {}, "costs": true})");
    const fs::path out = run(read_config(folder / "study.json"), "a");
    const CellStore store(out, [](const std::string&) {});
    ShotTimes times;
    times.pairs = {{.technique = "v", .point = "p", .first_ms = 1, .second_ms = 2}};
    times.saved = {{.stage = "s", .milliseconds = 1}};
    times.savings = {{.technique = "v", .point = "p", .complete_ms = 1}};
    ClockProof clock;
    clock.checks.resize(1), clock.checks[0].measured_ms = {1, 2, 3}, clock.checks[0].ratio = {1, 2, 3};
    size_t count = 0;
    std::set<std::string> members;
    for (const std::string& name : store.names()) {
        Cell cell = *store.read(name);
        cell.timing = timing_entry(times, "s", clock);
        cell.notes = {"a note"};
        const nlohmann::json right = cell;
        std::vector<nlohmann::json::json_pointer> places;
        collect(right, nlohmann::json::json_pointer(), places);
        for (const auto& place : places)
            for (const nlohmann::json& other : others(right[place])) {
                nlohmann::json wrong = right;
                wrong[place] = other;
                const std::string said = error_message([&] { read_cell(wrong, "c.json: cell"); });
                const bool is_optional = other.is_null() || (right[place].is_null() && other.is_number()),
                           is_allowed = said == "no error" && (is_optional || place.back() == "target_relative_error" ||
                                                               place.back() == "from");  // numbers that are whole here
                const std::string key = place.back() == "0" ? "[0]" : place.back();
                EXPECT_TRUE(is_allowed || (said.starts_with("c.json: cell") && said.find(key) != std::string::npos))
                    << place.to_string() << " = " << other << ": " << said;
                ++count;
                members.insert(place.back());
            }
    }
    EXPECT_GT(count, 1000u);
    for (const char* member : {"halves", "seed_numbers", "value", "reference_noise", "first_ms", "commit"})
        EXPECT_TRUE(members.contains(member)) << "no cell has it: " << member;
}

TEST_F(HostileFolder, ShortListsInCellsAreNamed) {
    const fs::path out = run(small(), "a");
    const CellStore store(out, [](const std::string&) {});
    const auto saying = [&](const char* list, const std::function<void(Cell&)>& shorten) {
        for (const std::string& name : store.names()) {
            Cell cell = *store.read(name);
            const Cell whole_cell = cell;
            if (cell.reference_noise.empty() || cell.splits.empty()) continue;
            shorten(cell);
            store.save(name, cell);
            const std::string said = merging("a", "merged");
            EXPECT_NE(said.find(list), std::string::npos) << said;
            EXPECT_NE(said.find("a/cells/" + name + ".json: cell: "), std::string::npos) << said;
            store.save(name, whole_cell);
            return;
        }
        FAIL() << "no cell has what is to be shortened";
    };
    saying("reference_noise[0]: sums has 3 values and needs 256",
           [](Cell& cell) { cell.reference_noise[0].sums.resize(3); });
    saying("reference_noise[0]: growth has 3 values", [](Cell& cell) { cell.reference_noise[0].growth.resize(3); });
    saying("splits[0]: pairs: variance has 0 values", [](Cell& cell) { cell.splits[0].pairs.variance.clear(); });
    saying("splits[0]: reference_noise has 1 values", [](Cell& cell) { cell.splits[0].reference_noise.resize(1); });
    EXPECT_EQ(merging("a", "merged"), "no error");
}

TEST_F(HostileFolder, ARunDoesACellOfWrongTypesAgain) {
    const fs::path out = run(small(), "a");
    const std::string results = read_text(out / "results.csv");
    const CellStore store(out, [](const std::string&) {});
    const auto names = store.names();
    const auto name =
        std::ranges::find_if(names, [&](const std::string& one) { return !store.read(one)->images.empty(); });
    ASSERT_NE(name, names.end());
    Cell cell = *store.read(*name);
    cell.images[0]["frame"] = "a text";
    store.save(*name, cell);
    testing::internal::CaptureStdout();
    run(small(), "a");
    const std::string said = testing::internal::GetCapturedStdout();
    EXPECT_NE(said.find("/cells/" + *name + ".json: cell: images[0]: frame must be"), std::string::npos) << said;
    EXPECT_NE(said.find("the cell is not used"), std::string::npos) << said;
    EXPECT_EQ(read_json(out / "manifest.json")["run"]["cells_made"], 1);
    EXPECT_EQ(read_text(out / "results.csv"), results);
}
