#include "experiments/study/config/shots/capture_folder.h"

#include "core/error.h"
#include "core/path_inside.h"

#include <charconv>
#include <string_view>

namespace fs = std::filesystem;

namespace {

constexpr std::string_view frame_prefix = "frame_";

/// The folders that are named as frames.
std::map<unsigned, fs::path> frame_folders(const fs::path& folder) {
    std::map<unsigned, fs::path> folders;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(frame_prefix) || !entry.is_directory(error)) continue;
        unsigned number = 0;
        const char *first = name.data() + frame_prefix.size(), *last = name.data() + name.size();
        const auto [end, failure] = std::from_chars(first, last, number);
        if (failure != std::errc() || end != last)
            fail(entry.path().string(), ": a frame's folder is called ", frame_prefix, "<number>");
        if (!folders.emplace(number, path_inside(folder, name)).second)
            fail(entry.path().string(), ": frame ", number, " is there twice, also as ", folders[number].string(),
                 "; remove one of both");
    }
    if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
        fail_machine("cannot read ", folder.string(), ": ", error.message());
    return folders;
}

}  // namespace

std::map<unsigned, fs::path> capture_frames(const fs::path& folder) {
    std::error_code error;
    const bool is_single = fs::exists(path_inside(folder, "gbuffer.exr"), error);
    std::map<unsigned, fs::path> folders = frame_folders(folder);
    if (is_single && !folders.empty())
        fail(folder.string(), " holds both a gbuffer.exr and folders ", frame_prefix,
             "<number>; keep the file for a single frame, the folders for several");
    if (!is_single && folders.empty())
        fail(folder.string(), " is no capture: it holds neither a gbuffer.exr nor folders ", frame_prefix,
             "<number> with one each; write them as experiments/bridges/captures/README.md says");
    if (is_single) folders[0] = folder;
    return folders;
}
