#pragma once
#include <filesystem>

// Files and folders are made under another name and renamed once they are whole, so that nobody takes a part for the
// whole. Who is killed meanwhile leaves the part, which the next process that writes there removes.

/// The name beside `path` for what becomes `path` once it is whole: "PATH.partial-WORD-PROCESS-NUMBER". Each call gives
/// another one. WORD stands for the boot and the namespace of process numbers.
std::filesystem::path unfinished_path(const std::filesystem::path& path);

/// Whether it has a name of unfinished_path() and nobody works at it any more: its process has ended. Of a process that
/// cannot be asked, in another container or on another machine: it was last changed more than a day ago.
bool is_leftover(const std::filesystem::path& path);

/// Removes the leftovers in a folder, not in folders below. Those that cannot be removed stay.
void remove_leftovers(const std::filesystem::path& folder);
