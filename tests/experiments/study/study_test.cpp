// Whole studies, small ones: that a run repeats itself, continues where it stopped, and that leaving work out changes
// nothing.
#include "core/error.h"
#include "core/gpu/device.h"
#include "core/json.h"
#include "experiments/report/report.h"
#include "experiments/results/cells/cell_store.h"
#include "experiments/study/plan/study_plan.h"
#include "groundtruth/reference/reference_file.h"
#include "tests/experiments/study/study_fixture.h"

#include <map>
#include <set>
#include <sstream>
#include <thread>

TEST_F(StudyTest, RepeatsItselfAndContinues) {
    const Config study = config(R"(["mirror_pillars", "floating_holes"])");
    const std::string first = read_text(run(study, "a") / "results.csv");
    EXPECT_EQ(read_text(run(study, "b") / "results.csv"), first);

    // A killed run leaves cells and no tables; it must end with the same rows.
    size_t kept = 0;
    for (const auto& cell : fs::directory_iterator(folder / "a/cells"))
        if (kept++ % 2) fs::remove(cell.path());
    for (const char* file : {"results.csv", "times.csv", "manifest.json", "report.html"})
        fs::remove(folder / "a" / file);
    EXPECT_EQ(read_text(run(study, "a") / "results.csv"), first);
    EXPECT_TRUE(fs::exists(folder / "a/report.html"));
}

/// Shots that differ in a setting, a point that runs on one of them only, labels; read by the example as its user
/// would.
TEST_F(StudyTest, RunsADesignThatTheExampleReads) {
    write_text(folder / "study.json", R"({"shots": [{"scene": "fence", "resolution": [96, 54],
            "depth_format": ["d32f", "d16"], "label": "fence {settings}", "group": "mirrors"}],
        "reference": {"samples": 64}, "metrics": "mse", "targets": "specular", "timing": {"frames": 0},
        "techniques": [{"technique": "none", "baseline": true}, {"technique": "mcguire_dda", "label": "DDA, {dda.stride} px",
            "sweep": {"dda.stride": [1, 8]}, "skip_if": {"dda.stride": 8, "shot.depth_format": "d16"}}]})");
    const fs::path out = run(read_config(folder / "study.json"), "a");
    std::set<std::string> pairs;
    std::map<std::string, double> errors;
    for (const ResultRow& r : read_rows<ResultRow>(out / "results.csv")) {
        const std::string pair = r.shot.substr(r.shot.find("96x54")) + " " + r.point;
        pairs.insert(pair);
        EXPECT_EQ(r.non_finite, 0u);
        if (r.mask == "reflective") errors[pair] = r.value.value();
    }
    EXPECT_EQ(pairs, (std::set<std::string>{"96x54 default", "96x54 dda.stride=1", "96x54 dda.stride=8",
                                            "96x54.d16 default", "96x54.d16 dda.stride=1"}));
    EXPECT_LT(errors["96x54 dda.stride=1"], 0.5 * errors["96x54 default"]) << "linear tracing beats nothing on mirrors";
    EXPECT_NE(errors["96x54 dda.stride=1"], errors["96x54.d16 dda.stride=1"]) << "the depth that rays march through";
    const nlohmann::json manifest = read_json(out / "manifest.json");
    ASSERT_EQ(manifest["skipped"].size(), 1u);
    EXPECT_EQ(manifest["skipped"][0]["condition"], R"(skip_if {"shot.depth_format":"d16"})");
    EXPECT_EQ(manifest["shots"][0]["label"], "fence");
    EXPECT_EQ(manifest["shots"][1]["label"], "fence d16");
    EXPECT_EQ(manifest["shots"][1]["group"], "mirrors");
    EXPECT_EQ(manifest["shots"][1]["depth_format"], "d16");
    EXPECT_EQ(manifest["techniques"][2]["label"], "DDA, 8 px");
    // Debian's own Python, which has Debian's pandas.
    const std::string script = std::string(SSRLAB_SOURCE_DIR) + "/experiments/studies/examples/read_results.py ";
    ASSERT_EQ(std::system(("/usr/bin/python3 -B " + script + out.string() + " > " + out.string() + "/best").c_str()),
              0);
    std::istringstream lines(read_text(out / "best"));
    std::vector<std::string> points;
    for (std::string line, shot, technique, point; std::getline(lines, line);)
        if (std::istringstream(line) >> shot >> technique >> point) points.push_back(shot + " " + point);
    ASSERT_EQ(points.size(), 3u) << "a head and two shots";
    EXPECT_EQ(points[2], "fence.main.96x54.d16 dda.stride=1");
}

TEST_F(StudyTest, LeavingOutChangesNothing) {
    const Config study = config(R"(["all_rough", "sky_only", "fence"])");
    const auto lean = read_rows<ResultRow>(run(study, "lean") / "results.csv"),
               all = read_rows<ResultRow>(run(study, "all", true) / "results.csv");
    ASSERT_EQ(lean.size(), all.size());
    // The rasteriser's and the techniques' images are the same bits. The path tracer's extra features are identities
    // that round in other places: 1e-7 of a radiance, some hundred times that where a metric subtracts; its noise is
    // 1e-2.
    for (size_t i = 0; i < lean.size(); ++i) {
        ASSERT_EQ(lean[i].shot + lean[i].technique + lean[i].target + lean[i].metric + lean[i].mask,
                  all[i].shot + all[i].technique + all[i].target + all[i].metric + all[i].mask);
        EXPECT_EQ(lean[i].pixels, all[i].pixels);
        EXPECT_NEAR(lean[i].value.value_or(0), all[i].value.value_or(0),
                    1e-7 + 1e-4 * std::abs(lean[i].value.value_or(0)))
            << lean[i].shot << " " << lean[i].metric << " " << lean[i].mask;
    }
    const nlohmann::json complete = read_json(folder / "all/manifest.json");
    for (const auto& shot : complete["shots"]) EXPECT_TRUE(shot["left_out"].empty()) << shot["left_out"].dump();
    const nlohmann::json manifest = read_json(folder / "lean/manifest.json");
    for (const auto& shot : manifest["shots"]) {
        if (shot["scene"] == "fence") continue;
        bool leaves_trace_out = false;
        for (const auto& part : shot["left_out"])
            leaves_trace_out = leaves_trace_out || part["what"].get<std::string>().find("trace") != std::string::npos;
        EXPECT_TRUE(leaves_trace_out) << shot["scene"] << " " << shot["left_out"].dump();
    }
}

TEST_F(StudyTest, SkyIsExact) {
    const auto rows = read_rows<ResultRow>(run(config(R"("sky_only")"), "a") / "results.csv");
    ASSERT_FALSE(rows.empty());
    for (const ResultRow& r : rows) {
        if (r.metric != "mse" || r.target == "incident") continue;
        EXPECT_EQ(r.value.value(), 0.0) << r.target << " " << r.mask;
    }
}

TEST_F(StudyTest, ProcessesShareAFolder) {
    const Config study = config(R"(["mirror_pillars", "fence"])", R"(, "title": "shared")");
    const fs::path alone = run(study, "alone");
    std::string shell = "cd '" + folder.string() + "'; code=0; all=;";
    for (const char* log : {"log1", "log2", "log3"})
        shell += " SSRLAB_CACHE='" + (folder / "cache").string() +
                 "' '" SSRLAB_PROGRAM "' run study.json --out shared > " + log + " 2>&1 & all=\"$all $!\";";
    EXPECT_EQ(std::system((shell + " for one in $all; do wait $one || code=1; done; exit $code").c_str()), 0)
        << read_text(folder / "log1") << read_text(folder / "log2") << read_text(folder / "log3");
    for (const char* table : {"results.csv", "splits.csv"})
        EXPECT_EQ(read_text(folder / "shared" / table), read_text(alone / table)) << table;
    size_t cells = 0;
    for (const auto& entry : fs::directory_iterator(folder / "shared/cells")) {
        cells += entry.path().extension() == ".json";
        EXPECT_NE(entry.path().extension(), ".claim");
    }
    EXPECT_EQ(cells, 6u) << "two shots of two points, and the references of each";
}

TEST_F(StudyTest, PartsMakeTheWhole) {
    const Config study = config(R"(["mirror_pillars", "fence"])");
    const std::string alone = read_text(run(study, "alone") / "results.csv");
    const auto run_part = [&](const std::string& out, const std::vector<std::string>& cells) {
        run_study(study, {.out = folder / out,
                          .device = "",
                          .cache = folder / "cache",
                          .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                          .write_report = write_page,
                          .cells = cells});
    };
    const auto merge = [&](const std::vector<fs::path>& parts, const std::string& out) {
        return merge_study(study,
                           {.out = folder / out,
                            .device = "",
                            .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                            .write_report = write_page},
                           parts);
    };
    run_part("a", {"references"});
    run_part("b", {"renders", "shot=fence.*"});
    EXPECT_FALSE(fs::exists(folder / "b/results.csv")) << "tables are of all cells";
    testing::internal::CaptureStdout();
    EXPECT_THROW(merge({folder / "b"}, "merged"), Error);
    const std::string said = testing::internal::GetCapturedStdout();
    EXPECT_NE(said.find("do not count: their references are missing"), std::string::npos) << said;
    EXPECT_EQ(merge({folder / "a", folder / "b"}, "merged"), 2u) << "the other shot's points are missing";
    EXPECT_FALSE(read_json(folder / "merged/manifest.json")["is_complete"].get<bool>());
    run_part("c", {"renders", "technique=none"});
    run_part("c", {"renders", "technique=mcguire_dda", "shot=mirror*"});
    EXPECT_EQ(merge({folder / "a", folder / "b", folder / "c"}, "merged"), 0u);
    EXPECT_EQ(read_text(folder / "merged/results.csv"), alone);
    EXPECT_EQ(read_text(folder / "merged/splits.csv"), read_text(folder / "alone/splits.csv"));
    EXPECT_TRUE(fs::exists(folder / "merged/report.html"));
    // Whole, so that a run finds nothing to do.
    fs::remove_all(folder / "cache");
    EXPECT_EQ(read_text(run(study, "merged") / "results.csv"), alone);
    EXPECT_FALSE(fs::exists(folder / "cache")) << "no reference was looked for";
    EXPECT_EQ(read_json(folder / "merged/manifest.json")["run"]["cells_made"], 0);

    Config other = study;
    other.source["title"] = "another";
    EXPECT_THROW(merge_study(other, {.out = folder / "x", .device = ""}, {folder / "a"}), Error);
    EXPECT_THROW(run_part("d", {"shot=nowhere"}), Error) << "a selection of nothing is a mistake";
    EXPECT_NO_THROW(run_part("d", {"shot=nowhere", "shard=1/2"})) << "but for a part of several";
}

/// Names the cells of a folder as if another device had made them.
void make_on_another_device(const Config& study, const fs::path& folder, const std::string& device) {
    const std::vector<fs::path> search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"};
    const DeviceInfo here = Device().info(), there{.name = device, .driver = "a driver"};
    const StudyPlan of_here = plan_study(study, here, search_path, false),
                    of_there = plan_study(study, there, search_path, false);
    const CellStore store(folder, [](const std::string& text) { ADD_FAILURE() << text; });
    for (size_t s = 0; s < of_here.shots.size(); ++s)
        for (size_t c = 0; c < of_here.shots[s].cells.size(); ++c) {
            const std::string& name = of_here.shots[s].cells[c].name;
            std::optional<Cell> cell = store.load(name);
            if (!cell) continue;
            cell->provenance["device"]["name"] = device, cell->provenance["device"]["driver"] = "a driver";
            fs::remove(store.file(name));
            store.save(of_there.shots[s].cells[c].name, *cell);
        }
}

TEST_F(StudyTest, PartsOfADeviceThatIsNotHereAreMerged) {
    const Config study = config(R"("fence")");
    const std::string alone = read_text(run(study, "here") / "results.csv");
    fs::copy(folder / "here", folder / "there", fs::copy_options::recursive);
    make_on_another_device(study, folder / "there", "Graphics 9000");
    const auto merge = [&](const std::vector<fs::path>& parts, const std::string& device, const std::string& out) {
        return merge_study(study,
                           {.out = folder / out,
                            .device = device,
                            .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                            .write_report = write_page},
                           parts);
    };
    const auto device_of = [&](const std::string& out) {
        return read_json(folder / out / "manifest.json")["provenance"][0]["device"]["name"].get<std::string>();
    };
    EXPECT_EQ(merge({folder / "there"}, "", "a"), 0u);
    EXPECT_EQ(read_text(folder / "a/results.csv"), alone);
    EXPECT_EQ(device_of("a"), "Graphics 9000");
    // Of several devices this machine's own counts, unless another is named.
    const std::vector<fs::path> both = {folder / "here", folder / "there"};
    EXPECT_EQ(merge(both, "", "b"), 0u);
    EXPECT_EQ(device_of("b"), Device().info().name);
    EXPECT_EQ(merge(both, "graphics", "c"), 0u);
    EXPECT_EQ(device_of("c"), "Graphics 9000");
    EXPECT_EQ(merge(both, "0", "d"), 0u) << "an index is one of this machine's, not a digit of a name";
    EXPECT_EQ(device_of("d"), Device("0").info().name);
    EXPECT_THROW(merge(both, "elsewhere", "e"), Error);

    // Finished cells that do not count are named with the reason, where cells are missing.
    make_on_another_device(study, folder / "here", "Graphics 10");
    fs::path of_a_point;
    for (const auto& entry : fs::directory_iterator(folder / "here/cells"))
        if (read_json(entry.path())["cell"]["shot"].is_null()) of_a_point = entry.path();
    fs::remove(of_a_point);
    testing::internal::CaptureStdout();
    EXPECT_EQ(merge(both, "Graphics 10", "f"), 1u);
    const std::string said = testing::internal::GetCapturedStdout();
    EXPECT_NE(said.find("note: 3 finished cells of " + (folder / "there").string() +
                        " do not count: made on Graphics 9000, a driver"),
              std::string::npos)
        << said;
}

TEST_F(StudyTest, WhatWasMeasuredAgainstAnotherTruthIsNotUsed) {
    // The same request may be answered by other pixels: where a time limit stops it, or on another processor.
    const Config study = config(R"("fence")");
    const std::string before = read_text(run(study, "a") / "results.csv");
    for (const auto& entry : fs::directory_iterator(folder / "cache"))
        if (entry.path().extension() == ".exr") {
            ReferenceState state = read_reference_state(entry.path());
            for (float& value : state.reference.specular.mean.values) value += 1;
            write_reference(entry.path(), state.reference, state.settings);
        }
    EXPECT_EQ(read_text(run(study, "a") / "results.csv"), before) << "all is done: nobody looks at the cache";
    fs::path of_references;
    for (const auto& entry : fs::directory_iterator(folder / "a/cells"))
        if (!read_json(entry.path())["cell"]["shot"].is_null()) of_references = entry.path();
    fs::copy(folder / "a", folder / "b", fs::copy_options::recursive);
    fs::remove(of_references);
    EXPECT_NE(read_text(run(study, "a") / "results.csv"), before) << "all cells of the shot are done again";
    EXPECT_EQ(read_json(folder / "a/manifest.json")["run"]["cells_made"], 3);
    EXPECT_THROW(merge_study(study,
                             {.out = folder / "c",
                              .device = "",
                              .search_path = {fs::path(SSRLAB_SOURCE_DIR) / "scenes"},
                              .write_report = write_page},
                             {folder / "a", folder / "b"}),
                 Error);
}

TEST_F(StudyTest, WhatIsFinishedIsNotReadAgain) {
    const Config study = config(R"("fence")");
    const fs::path out = run(study, "a");
    const std::string manifest = read_text(out / "manifest.json"), results = read_text(out / "results.csv");
    fs::remove_all(folder / "cache");
    run(study, "a");
    EXPECT_EQ(read_text(out / "manifest.json"), manifest) << "not even written again";
    EXPECT_FALSE(fs::exists(folder / "cache"));

    // Tables that are gone or were touched are made again, damaged images too.
    fs::remove(out / "report.html");
    run(study, "a");
    EXPECT_TRUE(fs::exists(out / "report.html"));
    write_text(out / "results.csv", "edited\n");
    run(study, "a");
    EXPECT_EQ(read_text(out / "results.csv"), results);
    const auto made = [&] { return read_json(out / "manifest.json")["run"]["cells_made"].get<int>(); };
    EXPECT_EQ(made(), 0);
    const std::string image = read_json(out / "manifest.json")["images"].back()["exr"];
    write_text(out / image, "damaged");
    run(study, "a");
    EXPECT_EQ(made(), 1);

    // Another study in the same folder is no end of this one.
    Config other = study;
    other.techniques.front().seeds = {5};
    run(other, "a");
    EXPECT_EQ(made(), 1);
    EXPECT_NE(read_text(out / "results.csv"), results);
}

/// Of hundreds of shots nobody reads more.
TEST_F(StudyTest, SaysALineForEachShot) {
    std::string sizes;
    for (int i = 0; i < 12; ++i)
        sizes += std::string(i > 0 ? "," : "") + R"({"scene": "mirror_pillars", "resolution": [16, )" +
                 std::to_string(9 + i) + "]}";
    write_text(folder / "study.json",
               R"({"shots": [)" + sizes + R"(], "reference": {"samples": 16}, "images": "none", "seeds": 1,
        "techniques": [{"technique": "none"}, {"technique": "mcguire_dda"}], "timing": {"frames": 0},
        "metrics": ["mse"], "primary": {"metric": "mse"}})");
    const Config study = read_config(folder / "study.json");
    // Lines that begin with a shot's name, and all others that are no warnings.
    const auto said = [&] {
        testing::internal::CaptureStdout();
        run(study, "a");
        std::istringstream lines(testing::internal::GetCapturedStdout());
        std::pair<size_t, size_t> count;
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("warning: ")) continue;
            ++(line.starts_with("mirror_pillars.main.") ? count.first : count.second);
        }
        return count;
    };
    const auto [of_shots, others] = said();
    EXPECT_EQ(of_shots, 12u);
    const auto [of_shots_again, others_again] = said();
    EXPECT_EQ(of_shots_again, 0u);
    // Two sentences about the study, one about the report and its path, with empty lines.
    EXPECT_LE(others, 8u);
    EXPECT_LE(others_again, 8u);
}

TEST_F(StudyTest, OtherSeedsMakeNewCells) {
    Config study = config(R"("fence")");
    for (const unsigned seed : {0, 7}) {
        for (PointConfig& technique : study.techniques) technique.seeds = {seed};
        const auto rows = read_rows<ResultRow>(run(study, "a") / "results.csv");
        ASSERT_FALSE(rows.empty());
        for (const ResultRow& r : rows) EXPECT_EQ(r.seed, seed);
    }
}

TEST_F(StudyTest, TimesEveryStageByTheProvenClock) {
    Config study = config(R"("fence")");
    study.timing = {.frames = 15, .warm_up = 2, .most_share = 0};
    const fs::path out = run(study, "a");
    const std::string written = read_text(out / "times.csv");
    const auto times = read_rows<TimeRow>(out / "times.csv");
    const auto frames_of = [&](const std::string& technique, const std::string& stage) {
        return std::ranges::count_if(times,
                                     [&](const TimeRow& t) { return t.technique == technique && t.stage == stage; });
    };
    EXPECT_EQ(frames_of("mcguire_dda", "mcguire_dda/trace"), 8) << "the least, of a budget of nothing";
    EXPECT_EQ(frames_of("mcguire_dda", "mcguire_dda/shade"), 8);
    EXPECT_EQ(frames_of("none", "mcguire_dda/trace"), 0);
    const nlohmann::json clock = read_json(out / "manifest.json")["clock"];
    ASSERT_EQ(clock["proofs"].size(), 1u);
    EXPECT_EQ(clock["proofs"][0]["checks"].size(), 3u);
    EXPECT_EQ(clock["proofs"][0]["shots"].size(), 1u);
    EXPECT_GT(clock["proofs"][0]["empty_submit_ms"].get<double>(), 0.0);
    ASSERT_EQ(clock["load"].size(), 1u);
    EXPECT_EQ(clock["load"][0]["host"]["cores"], std::thread::hardware_concurrency());

    run(study, "a");
    EXPECT_EQ(read_text(out / "times.csv"), written) << "whatever disturbed them, they are not taken again";
}

TEST_F(StudyTest, ACaptureIsMeasuredAsItsScene) {
    // G-buffers and references of frames in a row, saved and loaded back in the scene's place, must give the same
    // numbers: of a technique without and of one with a history, while the camera moves and while it rests.
    const std::string common =
        "cd '" + folder.string() + "' && SSRLAB_CACHE='" + (folder / "cache").string() + "' '" SSRLAB_PROGRAM "' ";
    const auto ssrlab = [&](const std::string& arguments) {
        ASSERT_EQ(std::system((common + arguments + " > log 2>&1").c_str()), 0) << read_text(folder / "log");
    };
    ssrlab("gbuffer disocclusion --camera lateral --size 64 36 --frames 3 4 --out capture");
    for (const std::string frame : {"3", "4"})
        ssrlab("reference disocclusion --camera lateral --size 64 36 --samples 16 --frame " + frame + " --out truth_0" +
               frame + ".exr");
    const auto study = [&](const std::string& name, const std::string& shot) {
        write_text(folder / (name + ".json"),
                   R"({"shots": [{)" + shot + R"(, "warm_up": 1, "repeat": 2}], "reference": {"samples": 16},
            "techniques": [{"technique": "mcguire_dda"},
                {"technique": "four_mode_ssr", "preset": "corrected", "parameters": {"mode": "temporal"}}],
            "seeds": 1, "timing": {"frames": 0}, "lit": "direct"})");
        return read_config(folder / (name + ".json"));
    };
    const Config of_capture = study("capture", R"("gbuffer": "capture", "reference": "truth_##.exr")"),
                 of_scene =
                     study("scene",
                           R"("scene": "disocclusion", "camera": "lateral", "resolution": [64, 36], "frames": [3, 4])");
    const auto capture = read_rows<ResultRow>(run(of_capture, "a") / "results.csv"),
               scene = read_rows<ResultRow>(run(of_scene, "b") / "results.csv");
    ASSERT_EQ(capture.size(), scene.size());
    ASSERT_GT(std::ranges::count(scene, "3", &ResultRow::frame), 0);
    for (size_t i = 0; i < scene.size(); ++i)
        EXPECT_EQ(capture[i].value, scene[i].value)
            << scene[i].technique << " " << scene[i].frame << " " << scene[i].target << " " << scene[i].metric << " "
            << scene[i].mask;

    // Without a truth it is rendered all the same.
    Config alone = of_capture;
    alone.techniques.resize(1);  // whose shaders are soon compiled
    alone.shots.front().reference.clear();
    EXPECT_TRUE(read_rows<ResultRow>(run(alone, "alone") / "results.csv").empty());
    EXPECT_FALSE(read_json(folder / "alone/manifest.json")["images"].empty());

    // The truth of another scene may have the same size.
    ASSERT_EQ(std::system((common + "reference fence --size 64 36 --samples 16 --out other.exr > log 2>&1").c_str()),
              0);
    Config mismatched = alone;
    mismatched.shots.front().reference = folder / "other.exr";
    EXPECT_THROW(run(mismatched, "c"), Error);
}
