#pragma once
#include <cstddef>
#include <string>

/// What the user can do about it.
inline constexpr const char* more_memory = "end other programs, or allow this one more (ulimit -v)";

/// The sentence for a lack of memory. `what`: " for WHAT".
std::string memory_sentence(const std::string& what);

/// Whether this process can get `bytes` more, as far as its limits (ulimit -v) and the machine's promises say. Memory
/// that is promised and missing later ends processes without a word.
bool can_get_memory(size_t bytes);
