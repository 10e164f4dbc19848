#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

/// The extension of a file's name in lower case: ".exr" for "A.EXR"; "" without one.
std::string lower_case_extension(const std::filesystem::path& file);

/// Makes the folder and those above it. Fails with MachineError if that is impossible.
void create_folder(const std::filesystem::path& folder);

/// Fails with MachineError: a file cannot be written for this reason, and what to do.
[[noreturn]] void fail_write(const std::filesystem::path& file, const std::string& reason);

/// Calls `write` with a name beside `file` for a file or a folder, then renames that to `file`; removes it if `write`
/// throws. Makes the folders above `file`, and removes leftovers beside it (leftovers.h). Fails with MachineError if a
/// folder or the new name cannot be made.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write);

/// Writes a text file by write_atomically(). Fails with MachineError if the disk is full or the folder cannot be
/// written.
void write_text(const std::filesystem::path& file, std::string_view text);
/// All bytes of a regular file. Fails with Error if it is no regular file, cannot be read, or is larger than may be
/// read (reading_limits.h).
std::string read_text(const std::filesystem::path& file);

/// The content hash of everything added, as 32 hexadecimal digits (XXH3, 128 bits).
class ContentHash {
public:
    ContentHash();
    ~ContentHash();
    ContentHash(const ContentHash&) = delete;
    ContentHash& operator=(const ContentHash&) = delete;

    void add(std::span<const std::byte> bytes);
    void add(std::string_view text);  ///< adds the length, too: "ab" and "c" differ from "a" and "bc"
    /// Adds the bytes of a number.
    template <class T>
    requires std::is_arithmetic_v<T>
    void add(T value) { add(std::as_bytes(std::span(&value, 1))); }
    std::string hex() const;

private:
    void* state_;
};
