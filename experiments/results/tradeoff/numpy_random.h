#pragma once
#include <array>
#include <cstdint>

/// The random numbers of NumPy's default_rng(seed): PCG64 (O'Neill 2014), seeded by SeedSequence, with its ziggurat for
/// normal deviates (Doornik 2005). They keep a study's answers equal, digit by digit, in every version.
class NumpyRandom {
public:
    explicit NumpyRandom(uint32_t seed);

    double uniform();  ///< in [0, 1)
    double normal();   ///< mean 0, standard deviation 1

private:
    using Wide = unsigned __int128;
    uint64_t next();

    Wide state_ = 0, increment_ = 0;
};
