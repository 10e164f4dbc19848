#pragma once
#include <array>
#include <cstdint>

/// The numbers of NumPy's default_rng(seed): PCG64 (O'Neill 2014), seeded by SeedSequence, and its ziggurat of normal
/// deviates (Doornik 2005). Kept so that the answers of a study stay the same, digit by digit, in every version.
class NumpyRandom {
public:
    explicit NumpyRandom(uint32_t seed);

    double uniform();  ///< in [0, 1)
    double normal();   ///< of mean 0 and deviation 1

private:
    using Wide = unsigned __int128;
    uint64_t next();

    Wide state_ = 0, increment_ = 0;
};
