#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

/// What files may cost, and which are read: files come from strangers, and a small one can ask for all memory.
struct ReadingLimits {
    uint64_t memory;              ///< bytes that everything being read may take at one time (--max-memory)
    bool allows_outside = false;  ///< files may name others outside of their own folder (--allow-outside)
};

/// The limits of the process. The command line sets them before anything is read; the default memory is half of
/// machine_memory().
ReadingLimits& reading_limits();

/// Memory of this machine (bytes).
uint64_t machine_memory();

/// Memory that shares may still set aside (bytes).
uint64_t memory_left();

/// Memory set aside for a file's content before it is used: readers add what the file's header announces. The last copy
/// gives it back. All shares together stay within reading_limits().memory. Threads may add to one share at the same
/// time.
class MemoryShare {
public:
    MemoryShare();
    /// Sets aside `bytes` more for `what`, which begins the message: "FILE: 20000 x 20000 pixels". Fails with Error,
    /// which names the bytes, the limit and the option, if that is too much.
    void add(double bytes, const std::string& what);
    /// Takes over what another one holds.
    void take(MemoryShare& other);

private:
    struct Held;
    std::shared_ptr<Held> held_;
};

/// Fails with Error if the file is not there, cannot be read, or is no regular file: a folder, a FIFO that would be
/// waited for, a device that never ends.
void check_regular_file(const std::filesystem::path& file);

/// The file which `named_by` names as `name`, relative to `folder`. Fails with Error, unless
/// reading_limits().allows_outside, if it is not below the folder: by an absolute path, by "..", or by links. The file
/// need not exist.
std::filesystem::path file_below(const std::filesystem::path& folder, const std::string& name,
                                 const std::string& named_by);
