#pragma once
#include <xmmintrin.h>

/// Makes denormals count as zero in this thread while it lives. Embree recommends it, and arithmetic on denormals is
/// slow.
class FlushDenormals {
public:
    FlushDenormals() { _mm_setcsr(before_ | 0x8040); }  // FTZ and DAZ
    ~FlushDenormals() { _mm_setcsr(before_); }

private:
    unsigned before_ = _mm_getcsr();
};
