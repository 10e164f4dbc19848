// Disks that are full, folders that cannot be written, processes that are killed: what is said, and that nothing is
// lost.
#include "core/elapsed.h"
#include "core/exr/exr.h"
#include "core/json.h"
#include "tests/experiments/cli/command_line_fixture.h"
#include "tests/leftover.h"
#include "variants/registry.h"

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>

namespace {

/// A folder for as long as the program runs.
struct KeptFolder {
    fs::path path = fs::temp_directory_path() / "faults_done";
    KeptFolder() { fs::remove_all(path), fs::create_directories(path); }
    ~KeptFolder() { fs::remove_all(path); }
};

/// The folder has a study and its results, `o`, with the cache of its references.
struct Faults : CommandLine {
    void SetUp() override {
        CommandLine::SetUp();
        config(study_of(R"([{"technique": "none"}, {"technique": "mcguire_dda"}])", 0));
        static const KeptFolder done;  // rendered once, for all tests
        if (fs::is_empty(done.path)) {
            const Outcome made = ssrlab("run study.json --out o");
            ASSERT_EQ(made.code, 0) << made.text;
            fs::copy(folder, done.path, fs::copy_options::recursive);
        } else {
            fs::copy(done.path, folder, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
        }
    }
    static std::string study_of(const std::string& techniques, int timed_frames) {
        return R"({"shots": [{"scene": ["mirror_pillars", "fence"], "resolution": [32, 18]}], "seeds": 2,
            "reference": {"samples": 16}, "timing": {"frames": )" +
               std::to_string(timed_frames) + R"(}, "techniques": )" + techniques + R"(,
            "tables": [{"name": "errors", "caption": "c", "of": "results", "rows": "technique", "columns": "shot",
                        "where": {"metric": "mse", "target": "specular", "mask": "reflective"}}]})";
    }
    void expect_fault(const std::string& arguments, const std::string& before = "") {
        const Outcome o = ssrlab(arguments, before);
        EXPECT_EQ(o.code, 3) << arguments << ": " << o.text;
        const size_t at = o.text.find("error: cannot ");
        EXPECT_NE(at, std::string::npos) << arguments << ": " << o.text;
        EXPECT_EQ(o.text.find("error: ", at + 1), std::string::npos) << "one sentence, not: " << o.text;
        EXPECT_EQ(o.text.find("Traceback"), std::string::npos) << o.text;
    }
    /// Content by name of the files of a results folder.
    std::map<std::string, std::string> contents(const std::string& out) {
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::recursive_directory_iterator(folder / out))
            if (entry.is_regular_file()) files[entry.path().lexically_relative(folder / out)] = read_text(entry.path());
        return files;
    }
};

const std::string full_disk = "trap '' XFSZ; ulimit -f 0; export MESA_SHADER_CACHE_DISABLE=true;";

}  // namespace

TEST_F(Faults, WhatCannotBeWrittenIsNamed) {
    write_exr(folder / "a.exr", HostImage({16, 16}, 3, 0.5f));
    write_text(folder / "tune.json",
               R"({"shots": [{"scene": "fence", "resolution": [16, 12]}], "timing": {"frames": 15},
        "techniques": [{"technique": "mcguire_dda"}], "tune": {"axes": {"dda.stride": [1, 2]}}})");
    // No user can make a folder there.
    for (const char* command :
         {"run study.json --out /proc/x", "merge study.json o --out /proc/x", "plan study.json --json /proc/x/y",
          "tables o --out /proc/x", "figures o --out /proc/x", "diff o o --csv /proc/x/y", "diff o o --page /proc/x/y",
          "gbuffer fence --size 8 8 --out /proc/x", "reference fence --size 8 8 --samples 16 --out /proc/x/y.exr",
          "compare a.exr a.exr --map /proc/x/y.exr", "stability --cases nan --out /proc/x",
          "stability --precision --out /proc/x", "tune tune.json --out /proc/x"})
        expect_fault(command);
}

TEST_F(Faults, AFullDiskLosesNothing) {
    const std::map<std::string, std::string> before = contents("o");
    const auto whole = [&](const std::string& after) {
        for (const auto& [name, content] : contents("o")) {
            const auto known = before.find(name);
            EXPECT_TRUE(known != before.end() && content == known->second) << after << " left or changed " << name;
        }
    };
    for (const char* command : {"report o", "report o --link-images", "merge study.json o --out o", "tables o",
                                "figures o", "run study.json --out o --prune", "diff o o --page p.html"}) {
        expect_fault(command, full_disk);
        whole(command);
    }
    expect_fault("run study.json --out other", full_disk);
    ASSERT_EQ(ssrlab("run study.json --out other").code, 0);
    EXPECT_EQ(contents("other")["results.csv"], before.at("results.csv"));
}

TEST_F(Faults, AFolderThatIsOnlyReadIsNamed) {
    std::string reader;  // root may write anywhere
    if (geteuid() == 0) reader = "setpriv --reuid=65534 --regid=65534 --clear-groups env";
    if (std::system((reader + " '" SSRLAB_PROGRAM "' --help > /dev/null 2>&1").c_str()) != 0)
        GTEST_SKIP() << "another user cannot run ssrlab here";
    ASSERT_EQ(std::system(("chmod -R a-w '" + folder.string() + "/o'").c_str()), 0);
    const std::map<std::string, std::string> before = contents("o");
    for (const char* command : {"report o", "tables o", "merge study.json o --out o", "run study.json --out o --prune"})
        expect_fault(command, reader);
    EXPECT_EQ(contents("o"), before);
    std::system(("chmod -R u+w '" + folder.string() + "/o'").c_str());
}

/// Address space for the program, for Vulkan's loader, driver and compiler, and for Embree: each of these fails first
/// at some of the limits.
TEST_F(Faults, LittleMemoryIsNamed) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers reserve terabytes of addresses";
#endif
    constexpr int out_of_memory = 3, not_loaded = 127, aborted = 128 + 6, bad_access = 128 + 11;
    for (const char* command : {"list devices", "reference fence --size 8 8 --samples 16 --out r.exr"}) {
        int named = 0;
        for (int mib = 60; mib <= 500; mib += 40) {
            const Outcome o = ssrlab(command, "ulimit -c 0; ulimit -v " + std::to_string(mib * 1024) + ";");
            SCOPED_TRACE(std::string(command) + " with " + std::to_string(mib) + " MiB: " + o.text);
            for (const char* other : {"install a driver", "processor", "InitializationFailed\n"})
                EXPECT_EQ(o.text.find(other), std::string::npos) << "that is not the reason";
            if (o.code == out_of_memory) {
                EXPECT_NE(o.text.find("error: not enough memory"), std::string::npos);
                ++named;
            } else if (o.code != 0 && o.code != not_loaded && o.code != aborted && o.code != bad_access) {
                ADD_FAILURE() << "code " << o.code;  // the last two: inside of a driver that does not expect it
            }
        }
        EXPECT_GT(named, 2) << command;
    }
}

TEST_F(Faults, WhatKilledCommandsLeftGoesWithTheNext) {
    fs::create_directories(folder / "tmp");
    for (const auto& [beside, command] : std::vector<std::pair<std::string, std::string>>{
             {"tmp/ssrlab-plan", "plan study.json"},
             {"o/report_images/shot/mcguire_dda/a.js", "report o --link-images"},
             {"o/report_images/shot/mcguire_dda/b.js", "report o"},
             {"o/report.html", "report o"},
             {"s/scene.glb", "scene-for any fence --size 8 8 --samples 16 --out s"},
             {"my_ssr", "new my_ssr"},
             {"o/tables/errors.csv", "tables o"}}) {
        const fs::path left = plant_leftover(folder / beside);
        const Outcome o = ssrlab(command, "TMPDIR='" + (folder / "tmp").string() + "'");
        EXPECT_EQ(o.code, 0) << command << ": " << o.text;
        EXPECT_FALSE(fs::exists(left)) << command << " keeps " << left;
    }
    EXPECT_TRUE(fs::is_empty(folder / "tmp"));
}

TEST_F(Faults, OutputFollowsNoLinkInItsFolder) {
    fs::create_directories(folder / "outside");
    const auto through = [&](const std::string& link, const std::string& command) {
        fs::remove_all(folder / "out");
        fs::create_directories((folder / "out" / link).parent_path());
        fs::create_directory_symlink(folder / "outside", folder / "out" / link);
        const Outcome o = ssrlab(command);
        EXPECT_EQ(o.code, 2) << command << ": " << o.text;
        EXPECT_NE(o.text.find("out/" + link + " is a symbolic link"), std::string::npos) << command << ": " << o.text;
        EXPECT_TRUE(fs::is_empty(folder / "outside")) << command;
    };
    ASSERT_EQ(ssrlab("new my_ssr").code, 0);
    through("fence.main.8x8", "scene-for any fence --size 8 8 --samples 16 --out out");
    through("textures", "scene-for any normal_mapped --size 8 8 --samples 16 --out out");
    through("frame_0001", "gbuffer fence --size 8 8 --frames 0 1 --out out");
    for (const char* part : {"technique", "now", "truth"})
        through(part, "watch my_ssr --scene fence --size 8 8 --samples 32 --out out");
    fs::remove_all(folder / "out");
    fs::create_directory_symlink(folder / "outside", folder / "out");  // which the user named
    EXPECT_EQ(ssrlab("gbuffer fence --size 8 8 --out out").code, 0);
    EXPECT_TRUE(fs::exists(folder / "outside/gbuffer.exr"));
}

/// Both signals wait until the process goes on, which has done nothing of its end by then.
TEST_F(Faults, TheSecondSignalEndsAWatchAtOnce) {
    ASSERT_EQ(ssrlab("new my_ssr").code, 0);
    const std::string watch = "'" SSRLAB_PROGRAM "' watch my_ssr --scene fence --size 8 8 --samples 32";
    const Outcome second =
        ssrlab("--version > /dev/null",
               "exec 2>&1; export SSRLAB_CACHE=\"$PWD/cache\"; " + watch + " > said & watch=$!; " +
                   "until grep -q http said; do kill -0 $watch || exit 1; sleep 0.02; done; " + watch + "; " +
                   "kill -STOP $watch; kill -INT $watch; kill -TERM $watch; kill -CONT $watch; wait $watch; echo ended "
                   "with $?;");
    EXPECT_NE(second.text.find("another `ssrlab watch` works in"), std::string::npos) << second.text;
    EXPECT_TRUE(second.text.find("ended with 143") != std::string::npos ||
                second.text.find("ended with 130") != std::string::npos)
        << second.text;
}

/// SSRLAB_KILLS: how many of them, for a longer test, of a study of all techniques that takes times, too.
TEST_F(Faults, KillsAtAnyMomentLoseNothing) {
    const char* asked = std::getenv("SSRLAB_KILLS");
    const auto run = [&](const std::string& out) {
        return "run study.json --out " + out + " --report-after 0 --cache " + out + "_cache";
    };
    double last_moment = 0.9;  // s
    if (asked) {
        setenv("SSRLAB_TIMING_LOCK", (folder / "timing.lock").c_str(), 1);
        nlohmann::json techniques;
        for (const TechniqueEntry& entry : technique_table()) techniques.push_back({{"technique", entry.name}});
        config(study_of(techniques.dump(), 15));
        fs::remove_all(folder / "o");
        const auto begin = std::chrono::steady_clock::now();
        ASSERT_EQ(ssrlab(run("o")).code, 0);
        last_moment = 0.5 * seconds_since(begin);
    }
    const auto alone = contents("o");
    const unsigned seed = std::random_device()();
    std::mt19937 random(seed);
    SCOPED_TRACE("moments by the seed " + std::to_string(seed));
    int runs = 0;
    const auto end_a_run = [&] {
        const Outcome last = ssrlab(run("killed"));
        EXPECT_EQ(last.code, 0) << last.text;
        EXPECT_EQ(last.text.find("damaged"), std::string::npos) << last.text;
        auto killed = contents("killed");
        for (const char* table : {"results.csv", "splits.csv", "effects.csv", "parameters.csv"})
            EXPECT_EQ(killed[table], alone.at(table)) << table;
        for (const char* table : {"summary.csv", "times.csv", "time_summary.csv"})  // some of whose columns are times
            EXPECT_EQ(std::ranges::count(killed[table], '\n'), std::ranges::count(alone.at(table), '\n')) << table;
        fs::remove_all(folder / "killed"), fs::remove_all(folder / "killed_cache");
        ++runs;
    };
    for (int kills = asked ? std::atoi(asked) : 5; kills > 0; --kills) {
        const double moment = std::uniform_real_distribution(0.05, last_moment)(random);
        ssrlab(run("killed") + " & sleep " + std::to_string(moment) + "; kill -KILL $! 2>/dev/null; wait $!; true");
        if (asked && fs::exists(folder / "killed/report.html") &&
            read_json(folder / "killed/manifest.json")["is_complete"].get<bool>())
            end_a_run();
    }
    end_a_run();
    if (asked)
        std::printf("%s kills, at most %.1f s after the start; the study ended %d times\n", asked, last_moment, runs);
}
