#pragma once
#include "core/reading_limits.h"

/// Other limits of reading, while it exists.
struct LimitsOf {
    explicit LimitsOf(ReadingLimits limits) { reading_limits() = limits; }
    ~LimitsOf() { reading_limits() = before; }
    LimitsOf(const LimitsOf&) = delete;
    LimitsOf& operator=(const LimitsOf&) = delete;
    ReadingLimits before = reading_limits();
};
