#pragma once
#include <filesystem>

/// The right of one watch to write into its folder. It ends with the object, and with the process however that ends.
class WatchLock {
public:
    /// Makes the folder. Fails with Error if another watch has the right. Where the file system has no locks, everybody
    /// gets it.
    explicit WatchLock(const std::filesystem::path& folder);
    ~WatchLock();
    WatchLock(const WatchLock&) = delete;
    WatchLock& operator=(const WatchLock&) = delete;

private:
    int descriptor_;
};
