// A program beside this one: its output, its end, and that of what it started.
#include "experiments/live/watch/running_program.h"
#include "core/error.h"
#include "core/files.h"
#include "tests/experiments/ends_soon.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <memory>
#include <sstream>

namespace fs = std::filesystem;

TEST(RunningProgram, RunsBesideThisOneAndGoesWithItsObject) {
    const fs::path folder = fs::temp_directory_path() / "running";
    fs::create_directories(folder);
    const auto script = [&](const std::string& text) {
        return std::make_unique<RunningProgram>(std::vector<std::string>{"/bin/sh", "-c", text}, folder / "out",
                                                folder / "err");
    };
    const auto code_of = [](RunningProgram& program) {
        while (!program.exit_code()) usleep(1000);
        return *program.exit_code();
    };
    EXPECT_EQ(code_of(*script("echo said; echo wrong >&2; exit 7")), 7);
    EXPECT_EQ(read_text(folder / "out"), "said\n");
    EXPECT_EQ(read_text(folder / "err"), "wrong\n");
    EXPECT_EQ(code_of(*script("kill -9 $$")), 137);
    EXPECT_EQ(code_of(*script("cat")), 0) << "it has nothing to read";
    RunningProgram polite({"/usr/bin/nice"}, folder / "out", folder / "err", RunningProgram::Priority::background);
    EXPECT_EQ(code_of(polite), 0);
    EXPECT_EQ(read_text(folder / "out"), "19\n") << "the niceness";

    auto sleeping = script("sleep 60 & echo $! $$; wait");
    while (fs::file_size(folder / "out") == 0) usleep(1000);
    EXPECT_FALSE(sleeping->exit_code());
    sleeping.reset();
    std::istringstream processes(read_text(folder / "out"));
    for (std::string process; processes >> process;) EXPECT_TRUE(ends_soon(process)) << process;
    EXPECT_THROW(RunningProgram({"/nonexistent/program"}, folder / "out", folder / "err"), MachineError);
    EXPECT_THROW(RunningProgram({"/bin/true"}, folder / "none/out", folder / "err"), MachineError);
    fs::remove_all(folder);
}
