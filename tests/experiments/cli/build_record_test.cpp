// What the program says of the code that it is made of.
#include "core/files.h"
#include "core/json.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cctype>
#include <filesystem>

namespace fs = std::filesystem;

namespace {

struct BuildRecord : testing::Test {
    fs::path folder = fs::temp_directory_path() / "build_record_test";

    void SetUp() override {
        fs::remove_all(folder);
        for (const char* inside : {"bin", "lib/ssrlab", "share"}) fs::create_directories(folder / inside);
        fs::copy_file(SSRLAB_PROGRAM, folder / "bin/ssrlab");
        fs::create_directory_symlink(SSRLAB_SOURCE_DIR, folder / "share/ssrlab");  // as if installed
    }
    void TearDown() override { fs::remove_all(folder); }

    /// What a copy of the program says of itself with this record.
    nlohmann::json build_info(const nlohmann::json& record) {
        write_text(folder / "lib/ssrlab/build_commit.json", record.dump());
        return build_info();
    }
    nlohmann::json build_info() {
        const std::string command =
            "'" + (folder / "bin/ssrlab").string() + "' --version > '" + folder.string() + "/said'";
        EXPECT_EQ(std::system(command.c_str()), 0);
        return read_json(folder / "said");
    }
};

}  // namespace

TEST_F(BuildRecord, IsWrittenByTheBuild) {
    const nlohmann::json record = read_json(fs::path(SSRLAB_PROGRAM).parent_path() / "build_commit.json");
    // Not compared with the code of now: whoever edits shaders need not build to test them.
    const std::string code = record["code"];
    EXPECT_EQ(code.size(), 32u);
    EXPECT_TRUE(std::ranges::all_of(code, [](unsigned char c) { return std::isxdigit(c); })) << code;
    EXPECT_TRUE(record["commit"].is_string() && record["dirty"].is_boolean()) << record.dump();
}

TEST_F(BuildRecord, IsDirtyIfTheCodeIsNoLongerThatOfTheBuild) {
    const std::string code = build_info()["code"];
    EXPECT_EQ(code.size(), 32u);
    const nlohmann::json clean = build_info({{"commit", "abc"}, {"dirty", false}, {"code", code}});
    EXPECT_EQ(clean["dirty"], false);
    EXPECT_EQ(clean["commit"], "abc");
    EXPECT_EQ(build_info({{"commit", "abc"}, {"dirty", true}, {"code", code}})["dirty"], true);
    EXPECT_EQ(build_info({{"commit", "abc"}, {"dirty", false}, {"code", "of another shader"}})["dirty"], true);
    EXPECT_EQ(build_info({{"commit", "abc"}, {"dirty", false}})["dirty"], true) << "a record that does not say";
}
