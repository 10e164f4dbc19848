#include "experiments/study/measuring/times/timing_lock.h"
#include "core/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <filesystem>
#include <thread>

namespace fs = std::filesystem;

namespace {

struct TimingLockTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / "timing_lock_test", file = folder / "lock";
    std::vector<std::string> notices;

    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    auto note() {
        return [this](const std::string& text) { notices.push_back(text); };
    }
    bool is_free() const {
        const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
        const bool is_free = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
        close(descriptor);
        return is_free;
    }
};

}  // namespace

TEST_F(TimingLockTest, IsHeldByOneAtATime) {
    {
        const TimingLock lock(note(), file);
        EXPECT_TRUE(lock.is_held());
        EXPECT_FALSE(is_free());
    }
    EXPECT_TRUE(is_free());
    EXPECT_TRUE(notices.empty());
}

TEST_F(TimingLockTest, SaysThatItWaits) {
    auto first = std::make_unique<TimingLock>(note(), file);
    // The other says so before it waits; only then is it let in.
    std::thread other([&] {
        const TimingLock second(
            [&](const std::string& text) {
                notices.push_back(text);
                first.reset();
            },
            file);
        EXPECT_TRUE(second.is_held());
    });
    other.join();
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices[0].find("another ssrlab takes times"), std::string::npos);
    EXPECT_NE(notices[0].find(file.string()), std::string::npos);
}

TEST_F(TimingLockTest, AnyUserMayHoldAnyUsersFile) {
    const mode_t before = umask(0077);
    { const TimingLock lock(note(), file); }
    umask(before);
    struct stat status {};
    ASSERT_EQ(stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0644u) << "readable, whatever the umask of who made it";
    chmod(file.c_str(), 0444);
    EXPECT_TRUE(TimingLock(note(), file).is_held());
}

TEST_F(TimingLockTest, GoesOnWithoutAFile) {
    EXPECT_FALSE(TimingLock(note(), folder / "nowhere/lock").is_held());
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices[0].find("without a lock"), std::string::npos);
    mkfifo(file.c_str(), 0666);  // opening a pipe would wait for its other end
    EXPECT_FALSE(TimingLock(note(), file).is_held());
    fs::remove(file);
    write_text(folder / "other", "");
    fs::create_symlink(folder / "other", file);
    EXPECT_FALSE(TimingLock(note(), file).is_held());
}
