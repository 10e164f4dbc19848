#include "core/path_inside.h"
#include "core/files.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <stdexcept>

namespace fs = std::filesystem;

TEST(PathInside, LeadsNowhereElse) {
    const fs::path outside = fs::temp_directory_path() / "path_inside_test", folder = outside / "results";
    fs::remove_all(outside);
    write_text(folder / "images/a.exr", "");
    fs::create_directory_symlink(outside, folder / "up");
    fs::create_symlink(outside / "gone", folder / "images/dangling");
    fs::create_directory_symlink(folder, outside / "also_results");
    EXPECT_EQ(path_inside(folder, "images/a.exr"), folder / "images/a.exr");
    EXPECT_EQ(path_inside(folder, "new/b.exr"), folder / "new/b.exr") << "what is to be written";
    EXPECT_EQ(path_inside(folder, "..b..c"), folder / "..b..c");
    EXPECT_EQ(path_inside(outside / "also_results", "x"), outside / "also_results/x") << "which the user named";
    for (const std::string& name :
         {std::string(""), std::string(".."), std::string("../a"), std::string("images/../../a"),
          std::string("images/.."), std::string("/etc/passwd"), std::string("a\0b", 3)})
        EXPECT_NE(error_message([&] {
                      path_inside(folder, name, "m.json: images[3]: 'exr'");
                  }).find("m.json: images[3]: 'exr': '"),
                  std::string::npos)
            << name;
    for (const char* name : {"up", "up/x", "up/", "images/dangling", "images/dangling/x"})
        EXPECT_NE(error_message([&] { path_inside(folder, name); }).find("is a symbolic link"), std::string::npos)
            << name;
    fs::remove_all(outside);
}

TEST(WriteText, ReplacesALinkAndWritesThroughNone) {
    const fs::path folder = fs::temp_directory_path() / "write_text_test";
    fs::remove_all(folder);
    write_text(folder / "outside", "mine");
    fs::create_symlink(folder / "outside", folder / "a");
    std::string temporary;
    EXPECT_ANY_THROW(
        write_atomically(folder / "b", [&](const fs::path& name) { throw std::runtime_error(temporary = name); }));
    // One waits under the next temporary name, whatever its number is.
    const size_t mark = (folder / "b").string().size(), number = temporary.rfind('-') + 1;
    const std::string next = std::to_string(std::stoul(temporary.substr(number)) + 1);
    fs::create_symlink(folder / "outside", folder / ("a" + temporary.substr(mark, number - mark) + next));
    write_text(folder / "a", "theirs");
    EXPECT_EQ(read_text(folder / "a"), "theirs");
    EXPECT_EQ(read_text(folder / "outside"), "mine");
    fs::remove_all(folder);
}
