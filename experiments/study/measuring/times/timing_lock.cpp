#include "experiments/study/measuring/times/timing_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace {

/// In a folder that all may write, Linux lets nobody open another's file with O_CREAT (fs.protected_regular), and a
/// link or a pipe there may be anybody's trap.
int open_lock_file(const char* file) {
    constexpr int flags = O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    int descriptor = open(file, flags);
    if (descriptor < 0 && errno == ENOENT) {
        descriptor = open(file, flags | O_CREAT, 0644);
        if (descriptor >= 0) fchmod(descriptor, 0644);       // whatever the umask: others must be able to read it
        if (descriptor < 0) descriptor = open(file, flags);  // another was faster
    }
    struct stat status {};
    if (descriptor >= 0 && (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))) {
        close(descriptor);
        errno = EINVAL;
        return -1;
    }
    return descriptor;
}

}  // namespace

std::filesystem::path TimingLock::timing_lock_file() {
    const char* variable = std::getenv("SSRLAB_TIMING_LOCK");
    return variable && *variable ? variable : "/tmp/ssrlab-timing.lock";
}

TimingLock::TimingLock(const std::function<void(const std::string&)>& notice, const std::filesystem::path& file)
    : descriptor_(open_lock_file(file.c_str())) {
    if (descriptor_ < 0) {
        notice("note: times are taken without a lock, so that another ssrlab may do so at the same time: cannot open " +
               file.string() + ": " + std::strerror(errno));
        return;
    }
    bool has_said = false;
    while (flock(descriptor_, has_said ? LOCK_EX : LOCK_EX | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        if (errno != EWOULDBLOCK) {
            notice("note: times are taken without a lock: " + file.string() + ": " + std::strerror(errno));
            return;
        }
        notice("note: another ssrlab takes times on this machine; waiting for it (" + file.string() + ")");
        has_said = true;
    }
    is_held_ = true;
}

TimingLock::~TimingLock() {
    if (descriptor_ >= 0) close(descriptor_);
}
