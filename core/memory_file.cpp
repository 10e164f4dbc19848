#include "core/memory_file.h"

#include "core/error.h"

#include <sys/mman.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

MemoryFile::MemoryFile() : file_(memfd_create("ssrlab", MFD_CLOEXEC)) {
    if (file_ < 0) fail_machine("cannot make a file in memory: ", std::strerror(errno));
}

MemoryFile::~MemoryFile() { close(file_); }

std::string MemoryFile::path() const { return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file_); }
