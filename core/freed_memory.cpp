#include "core/freed_memory.h"

#include <malloc.h>

void keep_freed_memory() {
    mallopt(M_TRIM_THRESHOLD, 1 << 28);
    mallopt(M_TOP_PAD, 1 << 24);
    mallopt(M_MMAP_THRESHOLD, 1 << 25);  // what most versions of glibc take at most
}
