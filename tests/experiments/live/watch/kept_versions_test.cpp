// The folder of a watch: one watch at a time, of one technique and its scenes, and nothing outside it is reached.
#include "experiments/live/watch/kept_versions.h"
#include "core/files.h"
#include "experiments/live/watch/watch_job.h"
#include "experiments/live/watch/watch_lock.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>

namespace fs = std::filesystem;

namespace {

struct WatchFolder : testing::Test {
    const fs::path root = fs::temp_directory_path() / "watch_folder_test", out = root / "out",
                   outside = root / "outside";

    void SetUp() override {
        fs::remove_all(root);
        write_text(outside / "victim", "the user's own");
        write_text(out / "technique/my_ssr/technique.json", "{}");
        write_text(out / "now/results.csv", "a table");
    }
    void TearDown() override { fs::remove_all(root); }

    WatchSettings of(const std::vector<std::string>& scenes, const char* folder = "my_ssr") const {
        WatchSettings settings;
        settings.folder = root / folder, settings.scenes = scenes, settings.out = out;
        return settings;
    }
    void expect_whole() const {
        EXPECT_EQ(std::distance(fs::directory_iterator(outside), {}), 1) << "nothing new in there";
        EXPECT_EQ(read_text(outside / "victim"), "the user's own");
    }
};

}  // namespace

TEST_F(WatchFolder, HoldsTheVersionsOfOneTechniqueInItsScenes) {
    KeptVersions(of({"fence"})).keep("", nlohmann::json::object(), {{"shots", nlohmann::json::array()}});
    EXPECT_EQ(KeptVersions(of({"fence"})).all().size(), 1u);
    for (const WatchSettings& other : {of({"room:1"}), of({"fence", "room:1"}), of({"fence"}, "elsewhere/my_ssr")}) {
        const std::string said = error_message([&] { KeptVersions versions(other); });
        EXPECT_NE(said.find("holds kept versions of another watch, {\"scenes\":[\"fence\"]"), std::string::npos)
            << said;
        EXPECT_NE(said.find("name another folder with --out"), std::string::npos) << said;
    }
    EXPECT_EQ(read_text(out / "numbers/my_ssr_1/results.csv"), "a table");
}

TEST_F(WatchFolder, LosesWhatAKilledWatchLeftOfAVersion) {
    KeptVersions(of({"fence"})).keep("", nlohmann::json::object(), nlohmann::json::object());
    for (const char* part : {"versions/my_ssr_2/technique.json", "numbers/my_ssr_2/results.csv"})
        write_text(out / part, "without an entry in versions.json");
    KeptVersions versions(of({"fence"}));
    EXPECT_FALSE(fs::exists(out / "versions/my_ssr_2"));
    EXPECT_FALSE(fs::exists(out / "numbers/my_ssr_2"));
    EXPECT_TRUE(fs::exists(out / "versions/my_ssr_1"));
    EXPECT_TRUE(fs::exists(out / "numbers/my_ssr_1"));
}

TEST_F(WatchFolder, IsOneWatchesAtATime) {
    {
        const WatchLock lock(out);
        EXPECT_NE(error_message([&] { WatchLock second(out); }).find("another `ssrlab watch` works in "),
                  std::string::npos);
        EXPECT_EQ(error_message([&] { WatchLock elsewhere(root / "other"); }), "no error");
    }
    EXPECT_EQ(error_message([&] { WatchLock later(out); }), "no error");
}

TEST_F(WatchFolder, ReachesNothingOutside) {
    const auto keep = [&] { KeptVersions(of({"fence"})).keep("", nlohmann::json::object(), nlohmann::json::object()); };
    const auto job = [&] { WatchJob(JobKind::now, of({"fence"}), nlohmann::json::object()); };
    const auto lock = [&] { WatchLock owned(out); };
    const std::vector<std::pair<std::string, std::function<void()>>> writers = {
        {"versions", keep},        {"numbers", keep},    {"technique", keep}, {"now", keep},
        {"versions.json", keep},   {"now", job},         {"now.out", job},    {"now.err", job},
        {"now.json", job},         {"watch.lock", lock}, {"now", keep},       {"versions/my_ssr_1", keep},
        {"numbers/my_ssr_1", keep}};
    for (const auto& [name, write] : writers) {
        SetUp();
        fs::remove_all(out / name);
        fs::create_directories((out / name).parent_path());
        const bool is_file = name.find('.') != std::string::npos;
        fs::create_symlink(is_file ? outside / "victim" : outside, out / name);
        const std::string said = error_message(write);
        EXPECT_NE(said.find(name + " is a symbolic link"), std::string::npos) << name << ": " << said;
        expect_whole();
    }
    SetUp();
    fs::create_symlink(outside / "victim", out / "now/linked.csv");
    keep();
    EXPECT_FALSE(fs::exists(out / "numbers/my_ssr_1/linked.csv")) << "what is not the study's is not copied";
}

TEST_F(WatchFolder, MayBeALinkItself) {
    fs::rename(out, root / "elsewhere");
    fs::create_directory_symlink(root / "elsewhere", out);
    KeptVersions(of({"fence"})).keep("", nlohmann::json::object(), nlohmann::json::object());
    EXPECT_TRUE(fs::exists(root / "elsewhere/versions/my_ssr_1/technique.json"));
}
