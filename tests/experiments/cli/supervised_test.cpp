// Work in a process of its own, and what is said when a signal ends it.
#include "experiments/cli/supervised.h"

#include "core/in_flight.h"
#include "core/json.h"
#include "tests/error_message.h"
#include "tests/experiments/cli/command_line_fixture.h"

#include <unistd.h>
#include <csignal>
#include <thread>

namespace {

/// A signal that sanitizers leave alone.
constexpr int fault = SIGXCPU;

int end_in(const char* technique, const char* pass) {
    const InFlightText technique_at_work(in_flight().technique, technique), point_at_work(in_flight().point, "default"),
        pass_at_work(in_flight().pass, pass);
    raise(fault);
    return 0;
}

TEST(Supervised, ReturnsTheExitCode) {
    EXPECT_EQ(supervised([](const auto&) { return 0; }, false), 0);
    EXPECT_EQ(supervised([](const auto&) { return 3; }, true), 3);
}

TEST(Supervised, NamesSignalTechniqueAndPass) {
    EXPECT_EQ(error_message([] { supervised([](const auto&) { return end_in("mine", "march"); }, false); }),
              "mine default: its pass 'march' ended the program by signal 24 (CPU time limit exceeded)");
    EXPECT_EQ(error_message([] { supervised([](const auto&) { return end_in("", "gbuffer"); }, true); }),
              "the program was ended by signal 24 (CPU time limit exceeded) in the pass 'gbuffer'");
    EXPECT_EQ(error_message([] { supervised([](const auto&) { return raise(SIGKILL); }, true); }),
              "the program was ended by signal 9 (Killed), as the system does where memory is short");
}

TEST(Supervised, GoesOnWithoutEachPointThatEndsIt) {
    const auto work = [](const std::vector<EndedPoint>& ended) {
        if (ended.empty()) return end_in("first", "march");
        if (ended.size() == 1) return end_in(ended[0].technique == "first" ? "second" : "?", "");
        return ended.size() == 2 && ended[1].technique == "second" &&
                       ended[1].how.find("work between its passes ended") == 0
                   ? 5
                   : 6;
    };
    EXPECT_EQ(supervised(work, true), 5);
}

TEST(Supervised, DoesNotTryAPointForever) {
    const auto work = [](const auto&) { return end_in("mine", "march"); };
    EXPECT_NE(error_message([&] { supervised(work, true); }).find("mine default: its pass 'march'"), std::string::npos);
}

TEST(Supervised, HandsRequestsToEndToTheWork) {
    const auto work = [](const auto&) {
        std::signal(SIGTERM, [](int) { _exit(7); });
        kill(getppid(), SIGTERM);
        std::this_thread::sleep_for(std::chrono::seconds(20));
        return 0;
    };
    EXPECT_EQ(supervised(work, false), 7);
}

TEST(Supervised, EndsTheWorkWithItself) {
    int pipe_of_child[2];
    ASSERT_EQ(pipe(pipe_of_child), 0);
    const pid_t supervisor = fork();
    if (supervisor == 0)
        _exit(supervised(
            [&](const auto&) {
                const pid_t self = getpid();
                if (write(pipe_of_child[1], &self, sizeof self) != sizeof self) return 1;
                std::this_thread::sleep_for(std::chrono::seconds(60));
                return 0;
            },
            false));
    pid_t work = 0;
    ASSERT_EQ(read(pipe_of_child[0], &work, sizeof work), ssize_t(sizeof work));
    close(pipe_of_child[1]);
    kill(supervisor, SIGKILL);
    waitpid(supervisor, nullptr, 0);
    char none;
    EXPECT_EQ(read(pipe_of_child[0], &none, 1), 0) << "its end of the pipe is closed";
    close(pipe_of_child[0]);
}

/// A study with a technique of a folder, whose last pass takes more processor time than the system allows it.
struct EndedByItsShader : CommandLine {
    void SetUp() override {
        CommandLine::SetUp();
        fs::create_directories(folder / "endless");
        const auto write_changed = [&](const char* file, const std::string& before, const std::string& after) {
            std::string text = read_text(fs::path(SSRLAB_SOURCE_DIR) / "variants/mcguire_dda" / file);
            ASSERT_NE(text.find(before), std::string::npos) << file;
            write_text(folder / "endless" / file, text.replace(text.find(before), before.size(), after));
        };
        write_changed("technique.json", "mcguire_dda/shade.comp", "shade.comp");
        // Long by its instructions, for llvmpipe leaves loops after 65535 rounds.
        write_changed("shade.comp", "void main() {",
                      "#define SINES x = sin(x * 9.0); x = sin(x * 9.0); x = sin(x * 9.0); x = sin(x * 9.0);\n"
                      "#define MORE SINES SINES SINES SINES SINES SINES SINES SINES SINES SINES\n"
                      "void main() {\n"
                      "    float x = float(gl_GlobalInvocationID.x);\n"
                      "    for (int i = 0; i < 60000; ++i) { MORE MORE MORE MORE MORE }\n"
                      "    if (x == 0.5) return;\n");
        config(R"({"shots": [{"scene": "fence", "resolution": [32, 18]}], "lit": "direct", "reference": {"samples": 16},
            "timing": {"frames": 0}, "metrics": ["mse"],
            "techniques": [{"technique": "none", "baseline": true}, {"technique": "./endless"}, {"technique": "mcguire_dda"}]})");
    }
};

TEST_F(EndedByItsShader, RunGoesOnWithTheOtherPoints) {
    const Outcome o = ssrlab("run study.json --out out", "ulimit -S -t 5;");
    EXPECT_EQ(o.code, 3);
    const std::string how = "its pass 'endless/shade' ended the program by signal 24 (CPU time limit exceeded)";
    for (const std::string& said :
         {"warning: endless default: " + how + "; the study goes on without this point",
          "error: the study has no results of endless default (" + how + "); the same command tries again"})
        EXPECT_NE(o.text.find(said), std::string::npos) << o.text;
    const std::string results = read_text(folder / "out/results.csv");
    EXPECT_NE(results.find(",mcguire_dda,"), std::string::npos);
    EXPECT_EQ(results.find(",endless,"), std::string::npos);
    const nlohmann::json manifest = read_json(folder / "out/manifest.json");
    EXPECT_EQ(manifest.at("skipped").at(0).at("condition"), how);
    EXPECT_EQ(manifest.at("warnings").back(), "endless default was left out: " + how);
    EXPECT_TRUE(fs::exists(folder / "out/report.html"));
}

}  // namespace
