#pragma once
#include <string>

/// A file in memory, gone with this process however it ends.
class MemoryFile {
public:
    /// Fails with MachineError if it cannot be made.
    MemoryFile();
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    /// The path by which other processes of the user can open the file, too.
    std::string path() const;

private:
    int file_;
};
