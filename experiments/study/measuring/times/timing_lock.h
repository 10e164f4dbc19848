#pragma once
#include <filesystem>
#include <functional>
#include <string>

/// A lock that is held while times are taken, by one process of all users of the machine. Other work is not held back
/// but measured (core/cpu_times.h).
class TimingLock {
public:
    /// Waits until the lock is free; `notice` gets a sentence if it has to wait. If the file cannot be opened there is
    /// no lock, and `notice` says so. `file`: SSRLAB_TIMING_LOCK, else /tmp/ssrlab-timing.lock. The file is never
    /// removed, and reading permission suffices: the lock is advisory (flock).
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
