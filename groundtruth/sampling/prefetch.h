#pragma once

/// Asks for the cache line of an address; nothing waits for the line. The empty statement counts as an effect: without
/// it GCC 12 takes a function that only prefetches for one without effects, and leaves its calls out.
inline void prefetch_line(const void* address) {
    __builtin_prefetch(address);
    asm volatile("" : : "r"(address));
}
