#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

/// Calls `write` with a temporary name beside `file`, then renames it to `file`; removes the temporary if `write` throws.
void write_atomically(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

/// Atomic text file. Fails with MachineError where the disk is full or the folder cannot be written.
void write_text(const std::filesystem::path& file, std::string_view text);
std::string read_text(const std::filesystem::path& file);

/// The content hash of everything added, as 32 hexadecimal digits (XXH3, 128 bits).
class ContentHash {
public:
    ContentHash();
    ~ContentHash();
    ContentHash(const ContentHash&) = delete;
    ContentHash& operator=(const ContentHash&) = delete;

    void add(std::span<const std::byte> bytes);
    void add(std::string_view text);
    /// Adds the bytes of a plain value without padding, or of a vector of such.
    template <class T>
        requires std::is_arithmetic_v<T>
    void add(T value) {
        add(std::as_bytes(std::span(&value, 1)));
    }
    std::string hex() const;

private:
    void* state_;
};
