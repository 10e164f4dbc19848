#include "core/numbered_files.h"
#include "core/files.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>

namespace fs = std::filesystem;

namespace {

class NumberedFiles : public testing::Test {
protected:
    void TearDown() override { fs::remove_all(folder); }
    void make(const std::string& name) const { write_text(folder / name, "x"); }
    std::vector<std::string> names(const std::string& pattern) const {
        std::vector<std::string> all;
        for (const fs::path& file : numbered_files(folder / pattern)) all.push_back(file.filename().string());
        return all;
    }
    fs::path folder = fs::temp_directory_path() / "numbered_files";
};

}  // namespace

TEST_F(NumberedFiles, NamesHaveLeadingZeros) {
    EXPECT_EQ(numbered_name("f_##.exr", 7), "f_07.exr");
    EXPECT_EQ(numbered_name("f_##.exr", 123), "f_123.exr");
    EXPECT_EQ(numbered_name("#/f_##.exr", 1), "#/f_01.exr");
    EXPECT_EQ(numbered_name("#/f.exr", 1, 2), std::nullopt);
    EXPECT_EQ(numbered_name("f.exr", 1), std::nullopt);
}

TEST_F(NumberedFiles, AreListedByNumber) {
    // 10 follows 9, as programs that pad to one digit write them.
    for (const char* name : {"f_8.exr", "f_10.exr", "f_9.exr", "f_007.exr", "f_x.exr", "g_7.exr", "f_7.png"})
        make(name);
    EXPECT_EQ(names("f_#.exr"), (std::vector<std::string>{"f_8.exr", "f_9.exr", "f_10.exr"}));
    EXPECT_EQ(names("f_###.exr"), (std::vector<std::string>{"f_007.exr"}));
    EXPECT_TRUE(is_numbered_pattern(folder / "f_#.exr"));
    EXPECT_FALSE(is_numbered_pattern(folder / "f.exr"));
    make("take#2.exr");
    EXPECT_FALSE(is_numbered_pattern(folder / "take#2.exr"));  // a file of that very name
    EXPECT_FALSE(is_numbered_pattern(folder / "of_#/f.exr"));
}

TEST_F(NumberedFiles, GapsAndEmptyPatternsAreRefused) {
    for (const char* name : {"f_1.exr", "f_2.exr", "f_5.exr"}) make(name);
    EXPECT_NE(error_message([&] { names("f_#.exr"); }).find("number 3 is missing before that of number 5"),
              std::string::npos);
    EXPECT_NE(error_message([&] { names("h_#.exr"); }).find("no file has a name of this pattern"), std::string::npos);
    EXPECT_NE(error_message([&] { numbered_files(folder / "none/f_#.exr"); }).find("cannot list the folder"),
              std::string::npos);
}
