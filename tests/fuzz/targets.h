#pragma once
#include <filesystem>
#include <span>

/// One reader of what strangers' files hold. `read` may fail with Error, and with nothing else.
struct FuzzTarget {
    const char* name;       ///< of its folder of inputs in tests/data/fuzz, too
    const char* file_name;  ///< that an input is given
    void (*read)(const std::filesystem::path& file);
    /// Other files in the folder of the input, which it may name; null: none.
    void (*prepare)(const std::filesystem::path& folder) = nullptr;
};

/// Those of the program that this is linked into.
std::span<const FuzzTarget> fuzz_targets();
