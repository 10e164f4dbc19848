// What a watch takes for a save, and what it copies.
#include "experiments/live/watch/watched_files.h"
#include "core/error.h"
#include "core/files.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace {

class WatchedFilesTest : public testing::Test {
protected:
    const fs::path root = fs::temp_directory_path() / "watched_files";
    const fs::path folder = root / "my_ssr";

    void SetUp() override {
        fs::remove_all(root);
        write_text(folder / "technique.json", "{}");
        write_text(folder / "parts/a.glsl", "// a");
    }
    void TearDown() override { fs::remove_all(root); }

    /// After a change a call sees it, the next one finds that it has settled.
    static bool is_seen(WatchedFiles& files) { return !files.have_changed() && files.have_changed(); }
};

}  // namespace

TEST_F(WatchedFilesTest, SeesEverySaveOnceAndWaitsForItsEnd) {
    WatchedFiles files(folder);
    EXPECT_FALSE(files.have_changed());
    write_text(folder / "parts/a.glsl", "// longer");
    EXPECT_FALSE(files.have_changed()) << "it may not be all yet";
    write_text(folder / "technique.json", "{\"a\": 1}");
    EXPECT_FALSE(files.have_changed()) << "another file came";
    EXPECT_TRUE(files.have_changed());
    EXPECT_FALSE(files.have_changed());
    fs::remove(folder / "parts/a.glsl");
    EXPECT_TRUE(is_seen(files)) << "a file that goes";
    fs::rename(folder, root / "elsewhere");
    EXPECT_TRUE(is_seen(files)) << "a folder that goes";
    fs::rename(root / "elsewhere", folder);
    EXPECT_TRUE(is_seen(files)) << "and comes again";
    write_text(folder / ".technique.json.swp", "an editor's");
    write_text(folder / "technique.json~", "an editor's");
    EXPECT_FALSE(is_seen(files));
}

TEST_F(WatchedFilesTest, CopiesWhatATechniqueHasAndNothingElse) {
    write_text(root / "secret", "not the technique's");
    fs::create_symlink(root / "secret", folder / "link.glsl");
    write_text(folder / ".hidden", "an editor's");
    write_text(root / "copy/my_ssr/old.glsl", "of the copy before");
    copy_technique(folder, root / "copy/my_ssr");
    std::vector<std::string> copied;
    for (const fs::path& file : technique_files(root / "copy/my_ssr")) copied.push_back(file.string());
    EXPECT_EQ(copied, (std::vector<std::string>{"parts/a.glsl", "technique.json"}));
    EXPECT_FALSE(fs::exists(root / "copy/my_ssr/link.glsl"));
    EXPECT_NE(error_message([&] { copy_technique(root / "none", root / "copy/none"); }).find("none is not a folder"),
              std::string::npos);
    for (unsigned i = 0; i < 501; ++i) write_text(folder / (std::to_string(i) + ".txt"), "");
    EXPECT_NE(error_message([&] { technique_files(folder); }).find("more than 500 files"), std::string::npos);
}
