#include "experiments/live/watch/watched_files.h"

#include "core/error.h"
#include "core/files.h"
#include "core/own_files.h"
#include "core/path_inside.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace {

constexpr size_t most_files = 500;
constexpr uintmax_t most_bytes = 64 << 20;
constexpr unsigned calls_between_looks_at_shared_files = 10;  // there are hundreds, and they rarely change

bool is_editors_own(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with('.') || name.starts_with('#') || name.ends_with('~') || name.ends_with(".swp");
}

bool is_shader_source(const fs::path& file) {
    for (const char* extension : {".glsl", ".comp", ".frag", ".vert", ".h"})
        if (file.extension() == extension) return true;
    return false;
}

/// Calls `use(entry)` for the regular files of a folder, without links and what editors leave. What goes while it is
/// looked at is passed over.
template <class Use>
void for_each_file(const fs::path& folder, const Use& use) {
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, error), end;
    for (; !error && entry != end; entry.increment(error)) {
        std::error_code gone;
        if (is_editors_own(entry->path()) || entry->is_symlink(gone)) {
            if (entry->is_directory(gone)) entry.disable_recursion_pending();
            continue;
        }
        if (entry->is_regular_file(gone)) use(*entry);
    }
}

}  // namespace

WatchedFiles::WatchedFiles(fs::path folder) : folder_(std::move(folder)) { reported_ = last_ = states_now(); }

WatchedFiles::States WatchedFiles::states_now() {
    const auto add = [](States& states, const fs::directory_entry& entry) {
        std::error_code error;
        State state{entry.last_write_time(error), 0};
        if (!error) state.size = entry.file_size(error);
        if (!error) states[entry.path().string()] = state;
    };
    if (calls_++ % calls_between_looks_at_shared_files == 0) {
        shared_.clear();
        for (const char* root : {"variants", "core"})
            for_each_file(own_files() / root, [&](const fs::directory_entry& entry) {
                if (is_shader_source(entry.path())) add(shared_, entry);
            });
    }
    States states = shared_;
    for_each_file(folder_, [&](const fs::directory_entry& entry) {
        if (states.size() < shared_.size() + most_files) add(states, entry);
    });
    return states;
}

bool WatchedFiles::have_changed() {
    States now = states_now();
    const bool is_settled = now == last_;
    last_ = std::move(now);
    if (!is_settled || last_ == reported_) return false;
    reported_ = last_;
    return true;
}

std::vector<fs::path> technique_files(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) fail(folder.string(), " is not a folder at the moment");
    std::vector<fs::path> files;
    uintmax_t bytes = 0;
    for_each_file(folder, [&](const fs::directory_entry& entry) {
        std::error_code gone;
        files.push_back(entry.path().lexically_relative(folder));
        bytes += entry.file_size(gone);
        if (files.size() > most_files || bytes > most_bytes)
            fail(folder.string(), " holds more than ", most_files, " files or ", most_bytes >> 20,
                 " MiB: the folder of a technique holds its technique.json and its shaders alone");
    });
    std::ranges::sort(files);
    return files;
}

void copy_technique(const fs::path& folder, const fs::path& to) {
    write_atomically(to, [&](const fs::path& made) {
        create_folder(made);
        for (const fs::path& file : technique_files(folder)) {
            const fs::path from = path_inside(folder, file.string()), copy = path_inside(made, file.string());
            create_folder(copy.parent_path());
            std::error_code error;
            fs::copy_file(from, copy, error);
            if (error) fail(from.string(), " cannot be read: ", error.message());
        }
        fs::remove_all(to);
    });
}
