#include "experiments/live/watch/watch_lock.h"

#include "core/error.h"
#include "core/files.h"
#include "core/path_inside.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

WatchLock::WatchLock(const std::filesystem::path& folder) {
    create_folder(folder);
    const std::filesystem::path file = path_inside(folder, "watch.lock");
    descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0)
        fail_machine("cannot write into the folder ", folder.string(), ": ", std::strerror(errno),
                     "; choose a folder that you may write to");
    while (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        if (errno != EWOULDBLOCK) return;
        close(descriptor_);
        fail("another `ssrlab watch` works in ", folder.string(), "; end it, or name another folder with --out");
    }
}

WatchLock::~WatchLock() { close(descriptor_); }
