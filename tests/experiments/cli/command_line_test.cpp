// What `ssrlab` says to mistakes and faults: one sentence, exit code 2 or 3, nothing half-written.
#include "core/exr/exr.h"
#include "core/json.h"
#include "tests/experiments/cli/command_line_fixture.h"

namespace {

const std::string good_shot = R"("shots": [{"scene": "sky_only", "resolution": [8, 8]}])";

}  // namespace

/// What terminals obey, and line feeds, which would make a line of their own.
TEST_F(CommandLine, ShowsNamesFromFilesAndObeysNone) {
    const auto expect_shown = [&](const Outcome& o, const std::string& name) {
        EXPECT_NE(o.text.find(name), std::string::npos) << o.text;
        EXPECT_EQ(o.text.find_first_of("\x1b\x07\r"), std::string::npos) << o.text;
        EXPECT_EQ(o.text.find("\nerror: forged"), std::string::npos) << o.text;
    };
    config("{\"a\\u001b[31m\\nerror: forged\": 1}");
    expect_shown(ssrlab("run study.json"), "a\\x1b[31m\\nerror: forged");
    fs::create_directories(folder / "scenes/b\x1b[1m\nerror: forged");
    write_text(folder / "scenes/b\x1b[1m\nerror: forged/scene.json",
               R"({"cameras": [{"name": "c\u001b]0;d\u0007\nerror: forged"}]})");
    write_text(folder / "scenes/b\x1b[1m\nerror: forged/about.txt", "e\x1b[2Jf\r");
    const Outcome listed = ssrlab("list scenes --scene-path scenes");
    expect_shown(listed, "b\\x1b[1m\\nerror: forged");
    expect_shown(listed, "Cameras: c\\x1b]0;d\\x07\\nerror: forged");
    expect_shown(listed, "e\\x1b[2Jf\\r");
}

TEST_F(CommandLine, NamesMistakesInConfigs) {
    expect_mistake("run nowhere.json", "nowhere.json");
    config("{\n \"shots\": [,]\n}");
    expect_mistake("run study.json", "study.json:2:");
    config("{" + good_shot + R"(, "techniques": [{"technique": "mcguire_dad"}]})");
    expect_mistake("run study.json", "did you mean 'mcguire_dda'?");
    config("{" + good_shot + R"(, "techniques": [{"technique": "mcguire_dda", "parameters": {"thicknes": 1}}]})");
    expect_mistake("run study.json", "did you mean 'dda.thickness'?");
    config(
        "{" + good_shot +
        R"(, "techniques": [{"technique": "mcguire_dda"}], "timing": {"frames": 15}, "tune": {"axes": {"dda.stride": [1, 2]}}})");
    for (const char* command : {"run", "plan"})
        expect_mistake(command + std::string(" study.json"), "`ssrlab tune` runs it");
    config("{" + good_shot + R"(, "techniques": [{"technique": "mcguire_dda", "parameters": {"dda.stride": 1000}}]})");
    expect_mistake("run study.json", "[1, 64]");
    config(R"({"shots": [{"scene": "sky_only", "resolution": [0, 8]}], "techniques": [{"technique": "none"}]})");
    expect_mistake("run study.json",
                   "'resolution' must be `[width, height]` in [1, 16384], or an array of such, not [0,8]");
    config("{" + good_shot + R"(, "techniques": [{"technique": "none"}], "refrence": {}})");
    expect_mistake("run study.json", "did you mean 'reference'?");
    config(
        R"({"shots": [{"scene": "mirror_pilars", "resolution": [8, 8]}], "techniques": [{"technique": "none"}], "timing": {"frames": 0}})");
    EXPECT_NE(ssrlab("run study.json --out o").text.find("did you mean 'mirror_pillars'?"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "o/results.csv"));
    config("{" + good_shot + R"(, "techniques": [{"technique": "mcguire_dda"}], "tune": {"most_runs": 9}})");
    expect_mistake("tune study.json", "it can only be extended");
}

TEST_F(CommandLine, PathsThatAreNoUtf8AreRefusedBeforeAnyWork) {
    config("{" + good_shot + R"(, "techniques": [{"technique": "none"}]})");
    fs::rename(folder / "study.json", folder / "caf\xe9.json");
    for (const char* command : {"run", "plan", "tune", "judge", "merge", "tradeoff", "report"})
        expect_mistake(command + std::string(" caf\xe9.json"), "'caf\\xe9.json' is not UTF-8");
    expect_mistake("run study.json --out o\xff", "'o\\xff' is not UTF-8");
}

/// A config is data. Its program runs only where the reader says so, also if another file names it.
TEST_F(CommandLine, RunsNoProgramOfAConfigUnasked) {
    const fs::path made = folder / "made";
    write_text(folder / "base.json", R"({"tune": {"program": ["/bin/sh", "-c", "touch )" + made.string() +
                                         R"("], "axes": {"rays": [1, 2]}, "most_runs": 9}})");
    config("{\"extends\": \"base.json\", " + good_shot +
           R"(, "techniques": [{"technique": "none", "baseline": true}]})");
    expect_mistake("tune study.json", "the search runs the program '/bin/sh -c touch");
    expect_mistake("tune study.json", "add --allow-program");
    EXPECT_FALSE(fs::exists(made));
}

TEST_F(CommandLine, TakesNoOptionForAFileOrAName) {
    for (const char* arguments : {"shaders mcguire_dda --assembly --help", "gbuffer fence --out --size",
                                  "rays mcguire_dda --preset --help", "describe scene --help"}) {
        const Outcome o = ssrlab(arguments);
        EXPECT_TRUE(o.code == 2 || o.text.find("Usage:") != std::string::npos) << arguments << ": " << o.text;
        EXPECT_TRUE(fs::is_empty(folder)) << arguments << ": " << o.text;
    }
    const Outcome o = ssrlab("shaders mcguire_dda --assembly --help");
    EXPECT_NE(o.text.find("'--help' is an option; for a file of this name write './--help'"), std::string::npos)
        << o.text;
}

TEST_F(CommandLine, NamesMistakesOfUnpackedMesas) {
    for (const char* command : {"shaders mcguire_dda --chip navi21", "list chips"}) {
        expect_mistake(command + std::string(" --mesa nowhere"), "'nowhere', does not exist");
        fs::create_directories(folder / "empty");
        expect_mistake(command + std::string(" --mesa empty"), "has no libvulkan_radeon.so");
        write_text(folder / "broken/usr/lib/libvulkan_radeon.so", "no library");
        expect_mistake(command + std::string(" --mesa broken"), "cannot be used: ");
    }
}

/// The steps of a search are studies in folders of their own, which name the technique.
TEST_F(CommandLine, SearchesATechniqueThatIsDeclared) {
    config(R"({"shots": [{"scene": "mirror_pillars", "resolution": [32, 18]}], "reference": {"samples": 16}, "seeds": 1,
        "timing": {"frames": 0}, "metrics": ["mse"], "masks": ["all"], "targets": ["image"],
        "techniques": [{"technique": "mcguire_dda"}],
        "tune": {"time": "operations", "most_runs": 1, "axes": {"dda.stride": [1, 2]}}})");
    const Outcome tuned = ssrlab("tune study.json --out tuned");
    EXPECT_EQ(tuned.code, 0) << tuned.text;
    EXPECT_TRUE(fs::exists(folder / "tuned/tuned.md")) << tuned.text;
}

TEST_F(CommandLine, PlansAndRefusesWhatThisMachineCannotHold) {
    // Also of a point that uses scene data, whose time does not depend on its rays.
    config(
        R"({"shots": [{"scene": "fence", "resolution": [48, 27]}], "reference": "none", "lit": "direct", "seeds": 1, "timing": {"frames": 0},
        "techniques": [{"technique": "mcguire_dda", "sweep": {"tracer": ["dda", "exact_scene"]}}]})");
    const Outcome small = ssrlab("plan study.json");
    EXPECT_EQ(small.code, 0) << small.text;
    EXPECT_NE(small.text.find("1 shot, 2 points"), std::string::npos) << small.text;
    config(
        "{" +
        std::string(
            R"("shots": [{"scene": "sky_only", "resolution": [16384, 16384]}], "reference": "none", "lit": "direct", "techniques": [{"technique": "none"}]})"));
    const Outcome large = ssrlab("plan study.json"), elsewhere = ssrlab("plan study.json --json plan.json");
    EXPECT_EQ(large.code, 2);
    EXPECT_NE(large.text.find("MiB of memory, and this machine has"), std::string::npos) << large.text;
    EXPECT_EQ(elsewhere.code, 0) << elsewhere.text;
}

TEST_F(CommandLine, PrintsCommandsThatAShellTakesAsTheyAre) {
    config(R"({"shots": [{"scene": "sky_only", "resolution": [16, 16]}], "techniques": [{"technique": "none"}],
               "timing": {"frames": 0}, "reference": {"samples": 16}})");
    fs::create_directories(folder / "it's here");
    fs::rename(folder / "study.json", folder / "it's here/my study.json");
    const std::string study = " \"it's here/my study.json\" --out 'to here'";
    const auto printed_command = [](const Outcome& o) { return o.text.substr(o.text.rfind("\n  ") + 1); };
    const auto run_elsewhere = [&](const std::string& command) {
        write_text(folder / "command.sh", "cd /\n" + command);
        return std::system(
            ("SSRLAB_CACHE='" + folder.string() + "/cache' sh " + (folder / "command.sh").string() + " >/dev/null 2>&1")
                .c_str());
    };
    const std::string planned = printed_command(ssrlab("plan" + study)),
                      merging = printed_command(ssrlab("run" + study + " --cells references"));
    EXPECT_NE(run_elsewhere(merging), 0) << "cells are missing, but was it run?\n" << merging;
    ASSERT_TRUE(fs::exists(folder / "to here/results.csv")) << merging;
    EXPECT_EQ(printed_command(ssrlab("merge" + study)), planned);
    EXPECT_EQ(run_elsewhere(planned), 0) << planned;
    EXPECT_NE(read_text(folder / "to here/manifest.json").find("\"is_complete\": true"), std::string::npos);

    const Outcome report = ssrlab("report 'to here'");
    EXPECT_EQ(report.text, "Report: " + (folder / "to here/report.html").string() + "\n");
}

TEST_F(CommandLine, ShowsWhatIsDoneOfAStudyThatRunsOrWasStopped) {
    config(
        R"({"shots": [{"scene": "sky_only", "resolution": [16, 16]}], "reference": {"samples": 16}, "timing": {"frames": 0}, "seeds": 16,
               "techniques": [{"technique": "none"}, {"technique": "amd_sssr"}, {"technique": "diligent_ssr"}]})");
    fs::create_directories(folder / "o");
    write_text(folder / "o/study.json", read_text(folder / "study.json"));
    expect_mistake("report o", "was stopped before its first results; the same `ssrlab run` continues it");
    fs::remove(folder / "o/study.json");
    expect_mistake("report o", "holds no results");
    const std::string run = "run study.json --out o --report-after 0";
    const Outcome stopped =
        ssrlab(run + " >log & while kill -0 $! && ! grep 'so far' log; do sleep 0.01; done; kill $!; wait $!; true");
    EXPECT_NE(stopped.text.find(fs::weakly_canonical(folder / "o/report.html").string()), std::string::npos)
        << stopped.text;
    const auto manifest = [&] { return read_json(folder / "o/manifest.json"); };
    EXPECT_FALSE(manifest()["is_complete"]);
    EXPECT_LT(manifest()["cells"]["done"], manifest()["cells"]["planned"]);
    EXPECT_NE(read_text(folder / "o/report.html").find("This study is not finished"), std::string::npos);

    EXPECT_EQ(ssrlab(run).code, 0);
    EXPECT_TRUE(manifest()["is_complete"]);
    EXPECT_EQ(manifest()["cells"]["done"], manifest()["cells"]["planned"]);
}

TEST_F(CommandLine, NamesBrokenFiles) {
    write_exr(folder / "a.exr", HostImage({16, 16}, 3, 0.5f));
    expect_mistake("compare a.exr b.exr", "b.exr: no such file");
    fs::copy(folder / "a.exr", folder / "cut.exr");
    fs::resize_file(folder / "cut.exr", fs::file_size(folder / "cut.exr") / 2);
    expect_mistake("compare a.exr cut.exr", "cut.exr");
    expect_mistake("compare a.exr a.exr --metric flop", "did you mean 'flip'?");
    write_exr(folder / "small.exr", HostImage({4, 4}, 3, 0.5f));
    expect_mistake("compare a.exr small.exr", "small.exr");
    fs::copy(fs::path(SSRLAB_SOURCE_DIR) / "scenes/fence/scene.glb", folder / "cut.glb");
    fs::resize_file(folder / "cut.glb", fs::file_size(folder / "cut.glb") / 2);
    expect_mistake("needs cut.glb", "cut.glb");
    expect_mistake("needs no_such_scene", "unknown scene 'no_such_scene'");
    expect_mistake("rays room:x", "no scene is called 'room:x'");
    EXPECT_EQ(ssrlab("rays \"room:*\" --count 0").code, 2);
    expect_mistake("figures .", "manifest.json");
    expect_mistake("describe mcguire", "unknown technique, tracer or denoiser 'mcguire'");
    EXPECT_EQ(ssrlab("reference fence --size 0 10").code, 2);
    expect_mistake("rnu study.json", "unknown command 'rnu'; did you mean 'run'?");
    expect_mistake("frobnicate", "known are: run, plan, tradeoff");
}

TEST_F(CommandLine, RefusesWhatNoNumberAndNoStackCanHold) {
    const std::string rest = ", " + good_shot + R"(, "techniques": [{"technique": "none"}]})";
    config("{\"title\": " + std::string(300'000, '[') + std::string(300'000, ']') + rest);
    expect_mistake("run study.json", "study.json: its JSON nests more than 100 levels");
    config("{\"reflective_max_roughness\": 1e400" + rest);
    expect_mistake("run study.json", "reflective_max_roughness: the number 1e400");
    config("{\"timing\": {\"frames\": 0, \"frames\": 15}" + rest);
    expect_mistake("run study.json", "study.json: timing: the key 'frames' comes twice");
    config("{" + good_shot +
           R"(, "techniques": [{"technique": "mcguire_dda", "parameters": {"dda.thickness": 1e39}}]})");
    expect_mistake("run study.json", "'dda.thickness' = 1e+39");
    const std::string name(300'000, 'n');
    for (const std::string extension : {"", ".json", ".glb"}) {
        config(R"({"shots": [{"scene": ")" + name + extension + R"("}], "techniques": [{"technique": "none"}]})");
        const Outcome o = ssrlab("run study.json");
        EXPECT_EQ(o.code, 2) << extension << o.text.substr(0, 500);
        EXPECT_LT(o.text.size(), 2000u);
    }
    config("{" + good_shot + R"(, "techniques": [{"technique": ")" + name + R"("}]})");
    expect_mistake("run study.json", "unknown technique 'nnn");
    // Names that are compared with a pattern.
    config("{" + good_shot + R"(, "techniques": [{"technique": "none"}], "masks": ["roughness_0_0.)" +
           std::string(300'000, '1') + R"(x"]})");
    expect_mistake("plan study.json", "'masks' must be");
}

TEST_F(CommandLine, StopsAReferenceByWhatWasAskedFor) {
    const Outcome o = ssrlab("reference roughness_gradient --size 16 9 --target 0.05 --out r.exr");
    const size_t end = o.text.find(" % of the pixels reached the target");
    ASSERT_NE(end, std::string::npos) << o.text;
    EXPECT_GT(std::stod(o.text.substr(o.text.rfind('\n', end) + 1)), 75.0) << o.text;  // 256 samples: less than half
}

TEST_F(CommandLine, SaysWhatTheMachineLacks) {
    const Outcome no_device = ssrlab("list devices", "VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent");
    EXPECT_EQ(no_device.code, 3) << no_device.text;
    EXPECT_NE(no_device.text.find("mesa-vulkan-drivers"), std::string::npos) << no_device.text;

    // A file size limit makes writes fail as a full disk does, with another errno. Vulkan's own files must not count.
    const Outcome full = ssrlab("reference fence --size 320 180 --samples 16 --out r.exr",
                                "trap '' XFSZ; ulimit -f 16; export MESA_SHADER_CACHE_DISABLE=true;");
    EXPECT_EQ(full.code, 3) << full.text;
    EXPECT_NE(full.text.find("error: cannot write"), std::string::npos) << full.text;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        EXPECT_EQ(entry.path().string().find(".partial"), std::string::npos) << entry.path();
    EXPECT_FALSE(fs::exists(folder / "r.exr"));
}

/// And at SIGTERM, by which batch systems end a job.
TEST_F(CommandLine, SaysAtCtrlCThatTheSameCommandContinues) {
    config(R"({"shots": [{"scene": "fence", "resolution": [96, 54]}], "reference": {"samples": 1000000}, "seeds": 1,
        "techniques": [{"technique": "none"}], "timing": {"frames": 0}})");
    // Shells let what they start in the background ignore Ctrl-C, and this program may be in one's background itself.
    write_text(folder / "stop.sh", "cd '" + folder.string() + R"('
rm -f log  # of the signal before, in which the loop would find its words too early
SSRLAB_CACHE="$PWD/cache" env --default-signal=INT ')" SSRLAB_PROGRAM R"(' run study.json > log 2>&1 &
while kill -0 $! && ! grep -qs '^fence.main.96x54$' log; do sleep 0.05; done
kill -"$1" $!
wait $!
)");
    for (const auto& [signal, code] : {std::pair("INT", 130), {"TERM", 143}}) {
        const int status = std::system(("bash '" + (folder / "stop.sh").string() + "' " + signal).c_str());
        EXPECT_EQ(WEXITSTATUS(status), code);
        EXPECT_TRUE(read_text(folder / "log").ends_with("\nstopped; the same command continues where it was\n"))
            << read_text(folder / "log");
    }
}

TEST_F(CommandLine, TakesNumbersOnlyThatAreFinite) {
    write_exr(folder / "a.exr", HostImage({16, 16}, 3, 0.5f));
    fs::create_directories(folder / "o");
    for (const std::string number : {"nan", "inf", "1x"})
        for (const std::string command :
             {"compare a.exr a.exr --exposure ", "compare a.exr a.exr --map-max ", "reference fence --seconds ",
              "reference fence --target ", "run study.json --report-after ", "tradeoff o --times ",
              "tradeoff o --factors "}) {
            const Outcome o = ssrlab(command + number);
            EXPECT_EQ(o.code, 2) << command << number << "\n" << o.text;
            EXPECT_NE(o.text.find("must be a number"), std::string::npos) << command << number << "\n" << o.text;
        }
}

TEST_F(CommandLine, FilesTakeNoMoreThanTheyMay) {
    write_exr(folder / "a.exr", HostImage({256, 256}, 3, 0.5f));  // 19.7 MB to compare
    expect_mistake("compare a.exr a.exr --max-memory 1MB", "allow more with --max-memory");
    EXPECT_EQ(ssrlab("compare a.exr a.exr --metric mse --max-memory 25MB").code, 0);
    const Outcome by_variable = ssrlab("compare a.exr a.exr", "SSRLAB_MAX_MEMORY=1MB");
    EXPECT_EQ(by_variable.code, 2) << by_variable.text;
    EXPECT_EQ(ssrlab("compare a.exr a.exr --max-memory much").code, 2);
    EXPECT_EQ(ssrlab("compare a.exr a.exr --max-memory -1").code, 2);

    std::string each = R"("frames": [1, 2, 3])";
    for (const char* key : {"near", "far", "scale", "radiance", "roughness", "camera"}) {
        each += std::string(", \"") + key + "\": [0";
        for (int i = 1; i < 30; ++i) each += ", " + std::to_string(i);
        each += "]";
    }
    write_text(folder / "cases.json",
               R"({"cases": [{"case": "c", "group": "g", "why": "w", "scene": "fence", "each": {)" + each + "}}]}");
    expect_mistake("stability --table cases.json", "cases[0]: 'each' needs");
}

TEST_F(CommandLine, WaitsForNoFifo) {
    const std::string fifo = (folder / "fifo").string();
    ASSERT_EQ(std::system(("mkfifo '" + fifo + "' '" + fifo + ".exr' '" + fifo + ".gltf' '" + fifo + ".json'").c_str()),
              0);
    for (const std::string command :
         {"run fifo", "plan fifo", "merge fifo", "tune fifo", "compare fifo.exr fifo.exr", "needs fifo.gltf",
          "reference fifo.json", "gbuffer fifo.json", "stability --table fifo"}) {
        const Outcome o = ssrlab(command, "timeout 120 env");
        EXPECT_EQ(o.code, 2) << command << "\n" << o.text;
        EXPECT_NE(o.text.find("it is a FIFO"), std::string::npos) << command << "\n" << o.text;
    }
}
