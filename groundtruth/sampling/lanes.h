#pragma once
#include "core/shared/language.h"

#include <bit>
#include <cstdint>

/// Paths advance side by side, one per lane. The rays of all lanes are traced one after the other, so that the
/// processor can begin one while it waits for another. Arithmetic is written as loops over all lanes, which the
/// compiler turns into vector instructions. Such loops are marked FOR_EACH_LANE and hold no calls, no early exits and
/// no stores in branches.
inline constexpr int lane_count = 16;

#define FOR_EACH_LANE _Pragma("GCC ivdep") for (int lane = 0; lane < lane_count; ++lane)

template <class T>
struct alignas(64) Lanes {
    T value[lane_count] = {};
    T& operator[](int lane) { return value[lane]; }
    const T& operator[](int lane) const { return value[lane]; }
};

struct LanesVec3 {
    Lanes<float> x, y, z;
    vec3 get(int lane) const { return {x[lane], y[lane], z[lane]}; }
    void set(int lane, vec3 v) { x[lane] = v.x, y[lane] = v.y, z[lane] = v.z; }
};

/// Calls work(lane) for each lane whose bit is set.
template <class Work>
void for_each_bit(uint32_t bits, const Work& work) {
    for (; bits != 0; bits &= bits - 1) work(std::countr_zero(bits));
}

/// v or zero, without a branch, for any v.
inline vec3 keep_if(bool condition, vec3 v) {
    return {condition ? v.x : 0.0f, condition ? v.y : 0.0f, condition ? v.z : 0.0f};
}

/// a or b, without a branch.
inline vec3 choose(bool condition, vec3 a, vec3 b) {
    return {condition ? a.x : b.x, condition ? a.y : b.y, condition ? a.z : b.z};
}
