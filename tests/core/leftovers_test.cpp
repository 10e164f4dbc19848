// What killed processes leave is removed by the next one that writes there, and nothing else is.
#include "core/leftovers.h"
#include "core/files.h"
#include "tests/leftover.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <chrono>

namespace fs = std::filesystem;

namespace {

struct Leftovers : testing::Test {
    // Another one for each test: a process looks for leftovers in a folder once.
    const fs::path folder = unfinished_path(fs::temp_directory_path() / "leftovers_test");
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
};

}  // namespace

TEST_F(Leftovers, OfAnEndedProcessGoWithTheNextWrite) {
    EXPECT_TRUE(is_leftover(plant_leftover(folder / "a.txt")));
    const fs::path made = plant_leftover(folder / "made");
    fs::remove(made);
    fs::create_directories(made / "whole/folders");
    write_text(folder / "b.txt", "another file");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
    EXPECT_EQ(read_text(folder / "b.txt"), "another file");
}

TEST_F(Leftovers, AreNotWhatOthersWorkAt) {
    const fs::path own = unfinished_path(folder / "a"), next = unfinished_path(folder / "a");
    EXPECT_NE(own, next);
    std::string elsewhere = own.filename();  // in another container or on another machine
    const size_t word = elsewhere.find("partial-") + 8;
    elsewhere[word] = elsewhere[word] == '0' ? '1' : '0';
    for (const std::string& name : {own.filename().string(), elsewhere, std::string("a.partial-1"),
                                    std::string("a.partial-12345678-1-x"), std::string(".partial-12345678-1-1")})
        write_text(folder / name, "kept");
    const fs::path foreign = folder / elsewhere;
    remove_leftovers(folder);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 5);
    fs::last_write_time(foreign, fs::file_time_type::clock::now() - std::chrono::hours(25));
    remove_leftovers(folder);
    EXPECT_FALSE(fs::exists(foreign)) << "nobody writes a file for a day";
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 4);
}

TEST_F(Leftovers, OfAWriteThatFailsAreNone) {
    EXPECT_ANY_THROW(write_atomically(folder / "made", [](const fs::path& made) {
        write_text(made / "part", "of a folder");
        throw std::runtime_error("the rest is missing");
    }));
    EXPECT_TRUE(fs::is_empty(folder));
    write_atomically(folder / "made", [](const fs::path& made) { write_text(made / "part", "of a folder"); });
    EXPECT_EQ(read_text(folder / "made/part"), "of a folder");
}
