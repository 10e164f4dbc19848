#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Notices when a file is saved: of a technique's folder, or one of ssrlab's own that shaders include. By sizes and
/// times of modification, so that it sees whatever way an editor saves, on any file system, and a folder that goes and
/// comes again.
class WatchedFiles {
public:
    explicit WatchedFiles(std::filesystem::path folder);

    /// Whether anything differs from what it was when this was last true, and has stayed as it is since the call
    /// before: who saves several files, or writes one in pieces, is waited for. Asked every 50 ms or so.
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

/// The regular files of a technique's folder, relative to it, in their order; what editors leave (hidden files, copies
/// that end in ~) and links are none. Fails with Error if there is no such folder, or if it has more files or bytes
/// than a technique can have.
std::vector<std::filesystem::path> technique_files(const std::filesystem::path& folder);

/// Makes `to` a copy of a technique's folder as it is now, in place of what was there. Fails with Error where a file
/// goes meanwhile.
void copy_technique(const std::filesystem::path& folder, const std::filesystem::path& to);
