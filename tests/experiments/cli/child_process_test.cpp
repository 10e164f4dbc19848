// Programs that ssrlab starts: arguments are data, whatever they hold, and none goes on that nobody asks for any more.
#include "core/child_process.h"
#include "core/error.h"
#include "core/files.h"
#include "experiments/cli/script_commands.h"
#include "tests/error_message.h"
#include "tests/experiments/ends_soon.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

namespace fs = std::filesystem;

TEST(ChildProcess, GivesTheExitCode) {
    EXPECT_EQ(run_program({"/bin/true"}), 0);
    EXPECT_EQ(run_program({"/bin/sh", "-c", "exit 7"}), 7);
    EXPECT_THROW(run_program({"/nonexistent/program"}), MachineError);
    EXPECT_NE(error_message([] { run_program({"/tmp"}); }).find("cannot start /tmp: "), std::string::npos);
    EXPECT_THROW(run_program({"/bin/sh", "-c", "kill -9 $$"}), MachineError);
}

/// A program that gets further may take longer than the limit; one that gets no further is ended, and its end is no
/// news of its own making.
TEST(ChildProcess, EndsOneThatHangs) {
    const fs::path file = fs::temp_directory_path() / "hanging";
    write_text(file, "");
    const Patience patience{std::chrono::seconds(3), [&] { return size_t(fs::file_size(file)); }};
    const auto run = [&](const std::string& script) {
        return run_program({"/bin/sh", "-c", script, file.string()}, &patience);
    };
    EXPECT_EQ(run("for i in $(seq 40); do sleep 0.1; echo $i >> \"$0\"; done; exit 5"), 5);
    EXPECT_NE(error_message([&] { run("echo more >> \"$0\"; exec sleep 3600"); }).find("made no progress for 3 s"),
              std::string::npos);
    fs::remove(file);
}

/// Whoever stops `ssrlab tune` stops its script, the program that the script runs and all that this one started: by a
/// signal to the command alone, or by Ctrl-C. It is said once.
TEST(ChildProcess, EndsWithThisProcessAndEndsWhatAScriptStarted) {
    const fs::path folder = fs::temp_directory_path() / "stopped";
    const std::string study = "sleep 60 & echo $! $$ $PPID > '" + (folder / "processes").string() + "'; exec sleep 60",
                      script = "import sys\nsys.path.insert(0, '" SSRLAB_SOURCE_DIR
                               "/experiments/python')\nfrom ssrlab import interrupts\n"
                               "from ssrlab.mistakes import exit_code\n"
                               "exit_code(lambda: interrupts.run(['/bin/sh', '-c', sys.argv[1]]), 'the results')";
    for (const auto& [signal, is_of_all] : {std::pair(SIGTERM, false), {SIGKILL, false}, {SIGINT, true}}) {
        SCOPED_TRACE(signal);
        fs::remove_all(folder);
        fs::create_directories(folder);
        const pid_t process = fork();
        if (process == 0) {
            setpgid(0, 0);
            if (!std::freopen((folder / "said").c_str(), "w", stderr)) _exit(99);
            try {
                _exit(run_program({"/usr/bin/python3", "-B", "-c", script, study}));
            } catch (...) {
                _exit(99);
            }
        }
        std::string engine_process, study_process, script_process;
        for (unsigned i = 0; i < 20000 && script_process.empty(); ++i, usleep(1000))
            std::ifstream(folder / "processes") >> engine_process >> study_process >> script_process;
        ASSERT_FALSE(script_process.empty()) << read_text(folder / "said");
        EXPECT_EQ(kill(is_of_all ? -process : process, signal), 0);
        waitpid(process, nullptr, 0);
        EXPECT_TRUE(ends_soon(engine_process));
        EXPECT_TRUE(ends_soon(study_process));
        EXPECT_TRUE(ends_soon(script_process));
        EXPECT_EQ(read_text(folder / "said"), "error: stopped before the results were written\n");
    }
    fs::remove_all(folder);
}

TEST(ChildProcess, HandsArgumentsOnAsTheyAre) {
    const fs::path folder = fs::temp_directory_path() / "child_process_test";
    fs::remove_all(folder);
    fs::create_directories(folder);
    const std::string odd = "it's; touch f; echo \"$HOME\" `id` \\ \n*";
    EXPECT_EQ(run_program({"/bin/sh", "-c", "printf %s \"$1\" > \"$0\"", (folder / "said").string(), odd}), 0);
    EXPECT_EQ(read_text(folder / "said"), odd);
    fs::remove_all(folder);
}

TEST(ChildProcess, FiguresOfAFolderOfAnyName) {
    const fs::path folder = fs::temp_directory_path() / "figures_test", made = folder / "made";
    for (const std::string& name : {"x'; touch '" + made.string() + "'; echo '", std::string("it's \"so\"")}) {
        fs::remove_all(folder);
        // A slash cannot be part of a name; the rest of the command is.
        const fs::path results = folder / name;
        write_text(results / "manifest.json", "{}");
        testing::internal::CaptureStderr();
        EXPECT_EQ(figures_command({results.string()}), 2) << "it has no tables: a mistake of the user";
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_NE(said.find((results / "summary.csv").string()), std::string::npos) << said;
        EXPECT_FALSE(fs::exists(made)) << "a path was run as a command";
    }
    fs::remove_all(folder);
}
