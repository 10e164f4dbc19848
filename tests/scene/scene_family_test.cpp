// Scenes by their number: made once, whole or not at all, and errors in a sentence.
#include "core/scene/scene_family.h"
#include "core/files.h"
#include "core/scene/load_scene.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstdlib>

namespace fs = std::filesystem;

namespace {

struct SceneFamilies : testing::Test {
    fs::path root = fs::temp_directory_path() / "scene_family_test";
    void SetUp() override {
        fs::remove_all(root);
        fs::create_directories(root);
        setenv("SSRLAB_CACHE", (root / "cache").c_str(), 1);
    }
    void TearDown() override {
        unsetenv("SSRLAB_CACHE");
        fs::remove_all(root);
    }
    /// What lies below the folder of the generator's hash.
    std::vector<std::string> made() const {
        std::vector<std::string> names;
        if (!fs::exists(root / "cache/scenes")) return names;
        for (const auto& hash : fs::directory_iterator(root / "cache/scenes"))
            for (const auto& entry : fs::directory_iterator(hash)) names.push_back(entry.path().filename().string());
        return names;
    }
};

}  // namespace

TEST_F(SceneFamilies, AreMadeOnceAndLoadByTheirName) {
    const fs::path file = scene_file_of_family("room:1");
    const auto when = fs::last_write_time(file);
    fs::create_directories(file.parent_path().parent_path() / "room_2.partial-1/room_2");
    const Scene scene = load_scene("room:1", {});
    EXPECT_EQ(fs::last_write_time(file), when) << "it was made again";
    EXPECT_EQ(scene.name, "room_1");
    EXPECT_EQ(scene.frame_count, 40u);
    EXPECT_EQ(scene.camera("path").frame_count, 40u);
    EXPECT_GT(scene.instances.size(), 20u);
    std::vector<std::string> names = made();
    std::ranges::sort(names);
    EXPECT_EQ(names, (std::vector<std::string>{"room_1", "room_2.partial-1"})) << "its own folder is renamed";
}

/// A disk that was full, a copy that was cut, a byte that flipped. Each process looks once; a child process is a new
/// one.
TEST_F(SceneFamilies, AreMadeAgainWhereTheyAreDamaged) {
    const fs::path file = scene_file_of_family("room:3"), folder = file.parent_path();
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    ASSERT_GE(files.size(), 3u);
    const auto is_healed = [&] {
        const pid_t child = fork();
        if (child == 0) _exit(scene_file_of_family("room:3") == file ? 0 : 1);
        int status = -1;
        waitpid(child, &status, 0);
        return status == 0;
    };
    for (const fs::path& damaged : files) {
        SCOPED_TRACE(damaged);
        const std::string whole = read_text(damaged);
        std::string changed = whole;
        changed[changed.size() / 2] ^= 1;
        for (const std::string& content : {whole.substr(0, whole.size() / 2), changed}) {
            write_text(damaged, content);
            EXPECT_TRUE(is_healed());
            EXPECT_EQ(read_text(damaged), whole);
        }
    }
    fs::remove(files.front());
    EXPECT_TRUE(is_healed());
    EXPECT_TRUE(fs::exists(files.front()));
    EXPECT_EQ(made(), std::vector<std::string>{"room_3"});
}

TEST_F(SceneFamilies, RefuseNamesThatAreNoNumber) {
    for (const char* name :
         {"room:-1", "room:1e9", "room:x", "street:", "room:1000000", "room:99999999999", "room:*"}) {
        const std::string said = error_message([&] { load_scene(name, {}); });
        EXPECT_NE(said.find(std::string("'") + name + "': after the colon stands a whole number from 0 to 999999"),
                  std::string::npos)
            << said;
    }
    EXPECT_TRUE(made().empty());
    EXPECT_TRUE(error_message([] { load_scene("hall:1", {}); }).starts_with("unknown scene 'hall:1'"));
    EXPECT_EQ(scenes_in_a_row("room:*", 5, 2), (std::vector<std::string>{"room:5", "room:6"}));
    EXPECT_NE(error_message([] { scenes_in_a_row("room:*", 999'999, 2); }).find("beyond 999999"), std::string::npos);
}

TEST_F(SceneFamilies, SayThatTheCacheCannotBeWritten) {
    write_text(root / "cache", "a file, not a folder");
    EXPECT_THROW(scene_file_of_family("room:1"), MachineError);
    const std::string said = error_message([] { scene_file_of_family("room:1"); });
    EXPECT_NE(said.find("cannot create the cache folder"), std::string::npos) << said;
}

/// A limit of the size of files is what a full disk is to the generator: it cannot write all of the scene.
TEST_F(SceneFamilies, LeaveNothingOfASceneThatIsNotWhole) {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{100'000, before.rlim_max};
    const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    std::string said = "it was made";
    bool is_machine = false;
    try {
        scene_file_of_family("room:1");
    } catch (const MachineError& error) {
        said = error.what(), is_machine = true;
    }
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, ignored);
    EXPECT_TRUE(is_machine) << said;
    EXPECT_NE(said.find("cannot make the scene 'room:1' in "), std::string::npos) << said;
    EXPECT_TRUE(made().empty()) << made().front();
}
