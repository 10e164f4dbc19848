#include "core/reading_limits.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/number_text.h"

#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace fs = std::filesystem;

namespace {

std::atomic<uint64_t> all_shares = 0;  ///< bytes

std::string size_text(double bytes) {
    const char* const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
    size_t unit = 0;
    for (; bytes >= 999.5 && unit + 1 < std::size(units); ++unit) bytes /= 1000;
    return number_text(bytes, 3) + " " + units[unit];
}

const char* kind_of(mode_t mode) {
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISFIFO(mode)) return "a FIFO";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

/// Whether the path begins with all parts of the folder.
bool is_below(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

uint64_t machine_memory() { return uint64_t(sysconf(_SC_PHYS_PAGES)) * uint64_t(sysconf(_SC_PAGE_SIZE)); }

uint64_t memory_left() {
    const uint64_t limit = reading_limits().memory, taken = all_shares;
    return limit - std::min(limit, taken);
}

ReadingLimits& reading_limits() {
    static ReadingLimits limits{.memory = machine_memory() / 2};
    return limits;
}

struct MemoryShare::Held {
    std::atomic<uint64_t> bytes = 0;
    ~Held() { all_shares -= bytes; }
};

MemoryShare::MemoryShare() : held_(std::make_shared<Held>()) {}

void MemoryShare::add(double bytes, const std::string& what) {
    const uint64_t limit = reading_limits().memory;
    uint64_t before = all_shares;
    do {
        if (!(double(before) + bytes <= double(limit)))
            fail(what, " needs ", size_text(double(before) + bytes), " of memory",
                 before ? " together with what was read before" : "", ", but files may take ", size_text(double(limit)),
                 "; if it is what you expect, allow more with --max-memory");
    } while (!all_shares.compare_exchange_weak(before, before + uint64_t(bytes)));
    held_->bytes += uint64_t(bytes);
}

void MemoryShare::take(MemoryShare& other) {
    if (held_ != other.held_) held_->bytes += other.held_->bytes.exchange(0);
}

void check_regular_file(const fs::path& file) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0)
        fail("cannot read ", shortened(file.string()), ": ",
             errno == ENOENT || errno == ENOTDIR ? "no such file; check its path" : std::strerror(errno));
    if (!S_ISREG(status.st_mode))
        fail("cannot read ", file.string(), ": it is ", kind_of(status.st_mode), ", not a regular file");
    if (access(file.c_str(), R_OK) != 0) fail("cannot read ", file.string(), ": no permission");
}

fs::path file_below(const fs::path& folder, const std::string& name, const std::string& named_by) {
    const fs::path file = folder / name;  // `name` alone if it is absolute
    if (reading_limits().allows_outside) return file;
    std::error_code error;
    const fs::path own = fs::weakly_canonical(folder.empty() ? "." : folder, error);
    const fs::path real = error ? fs::path() : fs::weakly_canonical(file, error);
    if (error || fs::path(name).is_absolute() || !is_below(real, own))
        fail(named_by, ": '", shortened(name),
             "' is not below the folder of the file that names it; if you trust that "
             "file, give --allow-outside");
    return file;
}
