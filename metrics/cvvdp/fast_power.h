#pragma once
#include <bit>
#include <cstdint>

// Powers that loops over pixels can vectorise, unlike those of the C library.

/// log2(x) for positive normal x, to 1e-7 of 1 + |log2 x|. From the series of artanh: ln m = 2 artanh((m - 1) / (m +
/// 1)), m in [sqrt(1/2), sqrt(2)), whose terms after the fifth stay below 2e-9 of the first.
inline float fast_log2(float x) {
    constexpr int32_t root_of_half = 0x3f3504f3;  // bits of sqrt(1/2)
    const int32_t bits = std::bit_cast<int32_t>(x);
    const int32_t exponent = (bits - root_of_half) >> 23;
    const float m = std::bit_cast<float>(bits - exponent * (1 << 23));
    const float t = (m - 1) / (m + 1), t2 = t * t;
    const float series = 1 + t2 * (1.0f / 3 + t2 * (1.0f / 5 + t2 * (1.0f / 7 + t2 * (1.0f / 9))));
    return float(exponent) + 2.885390082f * t * series;  // 2 / ln 2
}

/// 2^y for y in [-126, 127], to 3e-7 of it: the series of exp((y - n) ln 2) up to degree 7, n the integer nearest to y.
inline float fast_exp2(float y) {
    constexpr float to_integer = 12582912.0f;  // 1.5 x 2^23: the sum has no digits after the point
    const float n = (y + to_integer) - to_integer;
    const float f = 0.693147181f * (y - n);
    const float series =
        1 + f * (1 + f * (1.0f / 2 +
                          f * (1.0f / 6 + f * (1.0f / 24 + f * (1.0f / 120 + f * (1.0f / 720 + f * (1.0f / 5040)))))));
    return series * std::bit_cast<float>((int32_t(n) + 127) * (1 << 23));
}

/// x^e for positive normal x and e log2(x) in [-126, 127].
inline float fast_power(float x, float e) { return fast_exp2(e * fast_log2(x)); }
