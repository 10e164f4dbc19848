// A results folder over its life: whose it is, what is done again, what is left over, and who made what.
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/json.h"
#include "experiments/report/report.h"
#include "experiments/results/cells/cell_store.h"
#include "experiments/results/cells/file_name.h"
#include "experiments/results/cells/image_path.h"
#include "experiments/study/folder_owner.h"
#include "tests/experiments/study/study_fixture.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace {

struct FolderOwnerTest : StudyTest {
    Config study(const std::string& text) { return Config{.title = "t", .source = nlohmann::json::parse(text)}; }
    /// What is said when the study wants the folder; "" if it gets it.
    std::string claim(const std::string& text, bool keep_all = false, bool replaces = false) {
        try {
            const FolderOwner owner(folder / "out", study(text), keep_all, replaces,
                                    [&](const std::string& note) { notes.push_back(note); });
            fs::create_directories(folder / "out/cells");
            write_text(folder / "out/cells/a.json", "{}");
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    }
    std::vector<std::string> notes;
};

size_t count_images(const fs::path& page) {
    const std::string text = read_text(page);
    size_t count = 0;
    while (text.find("id=\"image-" + std::to_string(count) + "\"") != std::string::npos) ++count;
    return count;
}

size_t count_cells(const fs::path& out) { return size_t(std::distance(fs::directory_iterator(out / "cells"), {})); }

}  // namespace

TEST_F(FolderOwnerTest, BelongsToOneStudy) {
    EXPECT_EQ(claim(R"({"seeds": 2, "$schema": "x"})"), "");
    EXPECT_EQ(claim(R"({"seeds": 2})"), "") << "the same, to be continued";
    const std::string said = claim(R"({"seeds": 3, "lit": "direct"})");
    EXPECT_NE(said.find("another study, which differs in 'lit', 'seeds'"), std::string::npos) << said;
    EXPECT_NE(said.find("--out"), std::string::npos);
    EXPECT_NE(said.find("--replace"), std::string::npos);
    EXPECT_NE(claim(R"({"seeds": 2})", true).find("--keep-all"), std::string::npos);
    EXPECT_TRUE(notes.empty());
    EXPECT_EQ(claim(R"({"seeds": 3})", false, true), "");
    EXPECT_EQ(notes.size(), 1u);
    EXPECT_EQ(claim(R"({"seeds": 3})"), "");
    EXPECT_NE(claim(R"({"seeds": 2})"), "");
    write_text(folder / "out/study.json", "{ damaged");
    EXPECT_NE(claim(R"({"seeds": 3})").find("study.json:1:"), std::string::npos);
}

TEST_F(FolderOwnerTest, OfAVersionWithoutOwnersBelongsToItsManifest) {
    write_text(folder / "out/manifest.json", R"({"config": {"seeds": 2}})");
    EXPECT_NE(claim(R"({"seeds": 3})"), "");
    EXPECT_EQ(claim(R"({"seeds": 2})"), "");
    EXPECT_TRUE(fs::exists(folder / "out/study.json"));
}

TEST_F(FolderOwnerTest, IsFreeAgainAfterAMistake) {
    {
        const FolderOwner owner(folder / "out", study("{}"), false, false, [](const std::string&) {});
    }
    EXPECT_FALSE(fs::exists(folder / "out/study.json"));
    EXPECT_EQ(claim(R"({"seeds": 3})"), "");
}

TEST_F(StudyTest, AnotherStudyIsRefusedBeforeAnythingIsWritten) {
    const Config study = config(R"("sky_only")"), other = config(R"("sky_only")", R"(, "lit": "direct")");
    const std::string before = read_text(run(study, "a") / "manifest.json");
    EXPECT_THROW(run(other, "a"), Error);
    EXPECT_EQ(read_text(folder / "a/manifest.json"), before);
    EXPECT_EQ(count_cells(folder / "a"), 3u);
}

TEST_F(StudyTest, RedoesWhatIsMissingOrDamagedAndNothingElse) {
    const Config study = config(R"("mirror_pillars")");
    const fs::path out = run(study, "a");
    const std::string rows = read_text(out / "results.csv");
    const size_t shown = count_images(out / "report.html");
    EXPECT_GT(shown, 0u);
    fs::remove_all(out / "images");
    EXPECT_EQ(read_text(run(study, "a") / "results.csv"), rows);
    EXPECT_EQ(count_images(out / "report.html"), shown);
    const nlohmann::json manifest = read_json(out / "manifest.json");
    for (const auto& image : manifest["images"])
        EXPECT_EQ(file_hash(out / image["exr"].get<std::string>()), image["exr_hash"]);

    std::map<fs::path, fs::file_time_type> written;
    std::vector<fs::path> cells;
    for (const auto& cell : fs::directory_iterator(out / "cells")) {
        cells.push_back(cell.path());
        written[cell.path()] = cell.last_write_time();
    }
    ASSERT_EQ(cells.size(), 3u);
    std::string text = read_text(cells[0]);
    text[text.size() / 2] ^= 1;  // one bit
    write_text(cells[0], text);
    EXPECT_EQ(read_text(run(study, "a") / "results.csv"), rows);
    for (const fs::path& cell : cells) EXPECT_EQ(fs::last_write_time(cell) == written[cell], cell != cells[0]) << cell;
}

TEST_F(StudyTest, KeepsTheProvenanceOfEachCell) {
    const Config study = config(R"("sky_only")");
    const fs::path out = run(study, "a");
    const nlohmann::json before = read_json(out / "manifest.json");
    ASSERT_EQ(before["provenance"].size(), 1u);
    EXPECT_EQ(before["provenance"][0]["cells"].size(), 3u);
    EXPECT_EQ(before["is_complete"], true);

    // As if another machine had made one of them, a year before.
    const CellStore store(out, [](const std::string&) {});
    const std::string name = before["provenance"][0]["cells"][0]["cell"];
    Cell cell = *store.load(name);
    cell.provenance["host"]["name"] = "elsewhere", cell.provenance["started"] = "2025-01-01T00:00:00Z";
    store.save(name, cell);
    run(study, "a");
    const nlohmann::json after = read_json(out / "manifest.json");
    ASSERT_EQ(after["provenance"].size(), 2u);
    EXPECT_EQ(after["provenance"][0]["host"]["name"], "elsewhere");
    EXPECT_EQ(after["provenance"][0]["started"], "2025-01-01T00:00:00Z");
    EXPECT_EQ(after["provenance"][0]["cells"].size(), 1u);
    EXPECT_EQ(after["provenance"][1]["host"], before["provenance"][0]["host"]);
    EXPECT_EQ(after["provenance"][1]["finished"], before["provenance"][0]["finished"]) << "the run made nothing";
    EXPECT_NE(read_text(out / "report.html").find("made by different hosts"), std::string::npos);
}

TEST_F(StudyTest, ListsWhatIsStaleAndRemovesItWhenAsked) {
    Config study = config(R"("sky_only")");
    const fs::path out = run(study, "a");
    for (PointConfig& technique : study.techniques) technique.seeds = {7};  // other cells of the same study
    write_text(out / "images/mine.png", "a user's own");
    run(study, "a");
    EXPECT_EQ(count_cells(out), 5u) << "the references are the same";
    const nlohmann::json manifest = read_json(out / "manifest.json");
    EXPECT_EQ(manifest["stale"]["cells"].size(), 2u);
    EXPECT_GT(manifest["stale"]["images"].size(), 0u);
    run_study(study, {.out = out,
                      .device = "",
                      .cache = folder / "cache",
                      .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                      .prunes = true,
                      .write_report = write_page});
    EXPECT_EQ(count_cells(out), 3u);
    const nlohmann::json pruned = read_json(out / "manifest.json");
    EXPECT_FALSE(pruned.contains("stale"));
    EXPECT_TRUE(fs::exists(out / "images/mine.png"));
    std::set<std::string> listed;
    for (const auto& image : pruned["images"])
        for (const char* kind : {"exr", "png"}) listed.insert(out / image[kind].get<std::string>());
    for (const auto& entry : fs::recursive_directory_iterator(out / "images"))
        EXPECT_TRUE(entry.is_directory() || entry.path().filename() == "mine.png" || listed.contains(entry.path()))
            << entry.path();
}

TEST_F(StudyTest, ErrorImagesHoldErrors) {
    const fs::path out = run(config(R"("mirror_pillars")"), "a");
    const nlohmann::json manifest = read_json(out / "manifest.json");
    const auto image = [&](const char* technique, const char* kind) {
        for (const auto& i : manifest["images"])
            if (i["technique"] == technique && i["kind"] == kind && i["target"] == "specular") return i;
        return nlohmann::json();
    };
    const nlohmann::json entry = image("none", "error");
    const HostImage error = read_exr_rgb(out / entry["exr"].get<std::string>()),
                    result = read_exr_rgb(out / image("none", "result")["exr"].get<std::string>()),
                    truth = read_exr_rgb(out / image("reference", "reference")["exr"].get<std::string>());
    const double epsilon = entry["epsilon"];
    size_t negative = 0, positive = 0;
    for (size_t i = 0; i < error.values.size(); ++i) {
        const double r = truth.values[i], expected = (result.values[i] - r) / (std::abs(r) + epsilon);
        // Results and references are saved as half floats, of 11 bits.
        EXPECT_NEAR(error.values[i], expected,
                    2e-3 * (1 + std::abs(expected)) * (1 + std::abs(r) / (std::abs(r) + epsilon)));
        negative += error.values[i]<0, positive += error.values[i]> 0;
    }
    EXPECT_GT(negative, 100u) << "signed";
    EXPECT_GT(positive, 10u);
}

TEST(RelativeError, IsSignedByChannel) {
    HostImage reference({2, 1}, 3, 1.0f), test = reference;
    test.values = {2, 0.5f, 1, 1, 1, -1};
    const HostImage error = relative_error(test, reference);
    const float scale = 1 / 1.01f;
    EXPECT_FLOAT_EQ(error.values[0], scale);
    EXPECT_FLOAT_EQ(error.values[1], -0.5f * scale);
    EXPECT_FLOAT_EQ(error.values[5], -2 * scale);
}

TEST(FileName, IsBoundedAndTellsTextsApart) {
    EXPECT_EQ(file_name("v.a=1 b=\"x/y\""), "v.a-1-b--x-y-");
    const std::string text(300, 'p');
    EXPECT_EQ(file_name(text).size(), 100u);
    EXPECT_EQ(file_name(text).substr(0, 80), text.substr(0, 80));
    EXPECT_NE(file_name(text + "1"), file_name(text + "2"));
    EXPECT_EQ(file_name(std::string(100, 'p')), std::string(100, 'p'));
}

TEST_F(StudyTest, SweepsOfManyParametersFitIntoFileNames) {
    // Seven parameters, whose names and values together are longer than what file systems take.
    write_text(folder / "study.json",
               R"({"shots": [{"scene": "fence", "resolution": [32, 18]}], "reference": {"samples": 16},
        "timing": {"frames": 0}, "targets": ["specular"], "metrics": ["mse"],
        "techniques": [{"technique": "mcguire_dda", "sweep": {"hierarchy.max_traversal_intersections": [128],
            "hierarchy.min_traversal_occupancy": [4], "hierarchy.depth_buffer_thickness": [0.015],
            "max_roughness": [0.2], "hierarchy.thickness_at_hit_mip": [true],
            "tracer": ["hierarchy"], "hierarchy.clip_ray_to_near_plane": [true]}}]})");
    const Config study = read_config(folder / "study.json");
    ASSERT_EQ(study.techniques.size(), 1u);
    EXPECT_LE(study.techniques.front().point.size(), 58u);
    const nlohmann::json manifest = read_json(run(study, "a") / "manifest.json");
    for (const auto& image : manifest["images"])
        EXPECT_TRUE(fs::exists(folder / "a" / image["png"].get<std::string>())) << image["png"];
}

TEST_F(StudyTest, KeepsTheImagesOfEveryMeasuredFrame) {
    Config study =
        config(R"("mirror_pillars", "camera": "dolly", "frames": 3, "measure_from": 1)", R"(, "images": "all")");
    study.techniques.erase(study.techniques.begin());
    const auto kept = [&] {
        const nlohmann::json manifest = read_json(run(study, "a") / "manifest.json");
        std::map<std::string, std::vector<std::pair<unsigned, std::string>>>
            files;  // frame and name, by what they show
        for (const auto& image : manifest["images"])
            files[image["kind"].get<std::string>() + " " + image["target"].get<std::string>()].emplace_back(
                image["frame"], image["exr"]);
        for (const auto& [what, own] : files)
            for (const auto& [frame, name] : own) EXPECT_TRUE(fs::exists(folder / "a" / name)) << name;
        return files;
    };
    const auto all = kept();
    for (const char* what : {"result image", "result incident", "confidence confidence", "reference image",
                             "reference incident", "surface roughness"}) {
        ASSERT_TRUE(all.contains(what)) << what;
        ASSERT_EQ(all.at(what).size(), 2u) << what;
        EXPECT_EQ(all.at(what)[0].first, 1u) << what;
        EXPECT_EQ(all.at(what)[1].first, 2u) << what;
        EXPECT_NE(read_text(folder / "a" / all.at(what)[0].second), read_text(folder / "a" / all.at(what)[1].second))
            << what << " of the two frames is the same";
    }
    EXPECT_EQ(all.at("error specular").size(), 1u) << "targets are measured in the last frame";

    const size_t cells = count_cells(folder / "a");
    study.kept_images = KeptImages::played;
    const auto played = kept();
    for (const char* what : {"played specular", "result specular", "reference specular", "surface roughness"})
        EXPECT_EQ(played.at(what).size(), std::string(what) == "played specular" ? 4u : 1u) << what;
    for (const auto& [frame, name] : played.at("played specular")) EXPECT_LT(frame, 2u) << name;
    study.kept_images = KeptImages::last;
    for (const auto& [what, own] : kept()) {
        EXPECT_EQ(own.size(), 1u) << what;
        EXPECT_EQ(own.back().first, 2u) << what;
    }
    EXPECT_EQ(count_cells(folder / "a"), cells + 4) << "the point and the references' images are done anew";

    const std::string results = read_text(folder / "a/results.csv");
    study.kept_images = KeptImages::none;
    EXPECT_TRUE(kept().empty());
    EXPECT_EQ(read_text(folder / "a/results.csv"), results) << "numbers do not depend on what is kept";
    EXPECT_EQ(count_cells(folder / "a"), cells + 6) << "one study's cells have images, the other's have none";
}
