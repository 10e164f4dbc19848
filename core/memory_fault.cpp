#include "core/memory_fault.h"

#include <sys/mman.h>

std::string memory_sentence(const std::string& what) { return "not enough memory" + what + "; " + more_memory; }

bool can_get_memory(size_t bytes) {
    void* const got = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (got == MAP_FAILED) return false;
    munmap(got, bytes);
    return true;
}
