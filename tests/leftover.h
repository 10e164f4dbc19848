#pragma once
#include "core/files.h"
#include "core/leftovers.h"

#include <sys/wait.h>
#include <unistd.h>
#include <filesystem>
#include <fstream>

/// What a process leaves that is killed while it makes `path`: a file. Returns the path of what it left.
inline std::filesystem::path plant_leftover(const std::filesystem::path& path) {
    create_folder(path.parent_path());
    std::filesystem::path left = unfinished_path(path);
    std::string name = left.filename();
    const pid_t ended = fork();
    if (ended == 0) _exit(0);
    waitpid(ended, nullptr, 0);
    const std::string own = "-" + std::to_string(getpid()) + "-";
    name.replace(name.rfind(own), own.size(), "-" + std::to_string(ended) + "-");
    left.replace_filename(name);
    std::ofstream(left) << "a part";
    return left;
}
