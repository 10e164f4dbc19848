#pragma once
#include <filesystem>
#include <functional>
#include <string>

/// Held while times are taken: one process of all users of the machine at a time. Other work, of other ssrlab
/// processes too, is not held back but measured (core/cpu_times.h).
class TimingLock {
public:
    /// Waits until the lock is free, and says so to `notice` if it has to. Where the file cannot be opened there is no
    /// lock, which `notice` is told as well. `file` by default: SSRLAB_TIMING_LOCK, else /tmp/ssrlab-timing.lock; it
    /// stays, whoever made it, since only an advisory lock (flock) is put on it, for which reading it will do.
    explicit TimingLock(const std::function<void(const std::string&)>& notice,
                        const std::filesystem::path& file = timing_lock_file());
    ~TimingLock();
    TimingLock(const TimingLock&) = delete;
    TimingLock& operator=(const TimingLock&) = delete;

    bool is_held() const { return is_held_; }

    static std::filesystem::path timing_lock_file();

private:
    int descriptor_ = -1;
    bool is_held_ = false;
};
