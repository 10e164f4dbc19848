#pragma once
#include <xmmintrin.h>

/// Denormals count as zero while it lives: Embree recommends it, and arithmetic on them is slow. The mode belongs to a
/// thread.
class FlushDenormals {
public:
    FlushDenormals() { _mm_setcsr(before_ | 0x8040); }  // FTZ and DAZ
    ~FlushDenormals() { _mm_setcsr(before_); }

private:
    unsigned before_ = _mm_getcsr();
};
