#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Detects saves of files of a technique's folder and of ssrlab's own files that shaders include. It compares sizes and
/// times of modification, which works for any editor, any file system, and a folder that is removed and created again.
class WatchedFiles {
public:
    explicit WatchedFiles(std::filesystem::path folder);

    /// Whether files differ from when this last returned true, and are unchanged since the previous call. It thus waits
    /// while several files are saved, or one is written in pieces. Call it about every 50 ms.
    bool have_changed();

private:
    struct State {
        std::filesystem::file_time_type time;
        uintmax_t size = 0;
        bool operator==(const State&) const = default;
    };
    using States = std::map<std::string, State>;

    States states_now();

    const std::filesystem::path folder_;
    States shared_, last_, reported_;
    unsigned calls_ = 0;
};

/// The regular files of a technique's folder, relative to it, in order; without links and what editors leave (hidden
/// files, copies that end in ~). Fails with Error if the folder does not exist, or has more files or bytes than a
/// technique may have.
std::vector<std::filesystem::path> technique_files(const std::filesystem::path& folder);

/// Replaces `to` by a copy of a technique's folder. Fails with Error if a file disappears meanwhile.
void copy_technique(const std::filesystem::path& folder, const std::filesystem::path& to);
