#include "core/leftovers.h"

#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace fs = std::filesystem;

namespace {

constexpr const char* mark = ".partial-";

/// The word of this process's names, eight hexadecimal digits. The scripts make the same (text_files.py).
const std::string& word_here() {
    static const std::string word = [] {
        std::string boot;
        std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
        unsigned bits = 0;
        std::from_chars(boot.data(), boot.data() + std::min<size_t>(boot.size(), 8), bits, 16);
        struct stat processes {};
        if (stat("/proc/self/ns/pid", &processes) == 0) bits ^= unsigned(processes.st_ino);
        char text[9];
        std::snprintf(text, sizeof text, "%08x", bits);
        return std::string(text);
    }();
    return word;
}

bool is_old(const fs::path& path) {
    std::error_code error;
    const fs::file_time_type time = fs::last_write_time(path, error);
    return !error && fs::file_time_type::clock::now() - time > std::chrono::hours(24);
}

}  // namespace

fs::path unfinished_path(const fs::path& path) {
    static std::atomic<unsigned> counter = 0;
    fs::path beside = path;
    beside += mark + word_here() + "-" + std::to_string(getpid()) + "-" + std::to_string(counter++);
    return beside;
}

bool is_leftover(const fs::path& path) {
    const std::string name = path.filename().string();
    const size_t at = name.rfind(mark);
    if (at == std::string::npos || at == 0) return false;
    char word[9];
    int process = 0, length = 0;
    unsigned number = 0;
    const std::string end = name.substr(at + std::strlen(mark));
    if (std::sscanf(end.c_str(), "%8[0-9a-f]-%9d-%9u%n", word, &process, &number, &length) != 3 ||
        std::strlen(word) != 8 || size_t(length) != end.size() || process <= 0)
        return false;
    if (word != word_here()) return is_old(path);
    return kill(process, 0) != 0 && errno == ESRCH;
}

void remove_leftovers(const fs::path& folder) {
    std::error_code error, stays;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (is_leftover(entry->path())) fs::remove_all(entry->path(), stays);
}
