#pragma once
#include <cstdint>
#include <glm/glm.hpp>

/// Owen-scrambled Sobol' points, padded: every pair of dimensions is its own randomisation of the first two Sobol'
/// dimensions, which form a (0, 2)-sequence. Counter-based: a pair is a function of (seed, pair index, sample index)
/// and nothing else. Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4). All functions are branchless, for
/// vector loops.

inline uint32_t reverse_bits(uint32_t x) {
    x = x << 16 | x >> 16;
    x = (x & 0x00ff00ffu) << 8 | (x & 0xff00ff00u) >> 8;
    x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
    x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
    return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
}

/// Laine and Karras 2011's permutation with Burley's constants: each bit is flipped by a hash of the bits below it, so
/// that between two bit reversals it is an Owen scramble.
inline uint32_t laine_karras(uint32_t x, uint32_t seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

/// The second Sobol' dimension, bit-reversed. Its generator matrix is Pascal's triangle modulo 2: digit j is the sum of
/// all index bits i whose binary digits include those of j (Lucas' theorem), which five folds add up.
inline uint32_t reversed_sobol_y(uint32_t index) {
    index ^= index >> 16 & 0x0000ffffu;
    index ^= index >> 8 & 0x00ff00ffu;
    index ^= index >> 4 & 0x0f0f0f0fu;
    index ^= index >> 2 & 0x33333333u;
    return index ^ (index >> 1 & 0x55555555u);
}

/// A bijection of 32 bits whose output looks random (Wellons 2018, "Prospecting for Hash Functions", lowbias32).
inline uint32_t hash_bits(uint32_t x) {
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

/// The same for 64 bits (finaliser of MurmurHash3, technique 13 of Stafford).
inline uint64_t hash_bits_64(uint64_t x) {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ x >> 27) * 0x94d049bb133111ebull;
    return x ^ x >> 31;
}

/// [0, 1) from the upper 24 bits.
inline float unit_float(uint32_t bits) { return float(int32_t(bits >> 8)) * 0x1p-24f; }

/// All points of one seed.
struct SobolSequence {
    uint32_t seed_a, seed_b;

    explicit SobolSequence(uint64_t seed)
        : seed_a(uint32_t(hash_bits_64(seed))), seed_b(uint32_t(hash_bits_64(seed) >> 32)) {}
    /// The sequence of a lane, which stores both halves separately.
    SobolSequence(uint32_t seed_a, uint32_t seed_b) : seed_a(seed_a), seed_b(seed_b) {}

    /// 32-bit fixed-point coordinates of pair `pair` of a sample whose index has its bits reversed.
    glm::uvec2 bits(uint32_t reversed_sample, uint32_t pair) const {
        const uint32_t shuffle = hash_bits(seed_a + 0x9e3779b9u * pair);
        const uint32_t scramble_x = hash_bits(shuffle ^ seed_b), scramble_y = hash_bits(scramble_x + 0x85ebca6bu);
        const uint32_t index = reverse_bits(laine_karras(reversed_sample, shuffle));
        return {reverse_bits(laine_karras(index, scramble_x)),
                reverse_bits(laine_karras(reversed_sobol_y(index), scramble_y))};
    }
    glm::vec2 pair(uint32_t reversed_sample, uint32_t index) const {
        const glm::uvec2 b = bits(reversed_sample, index);
        return {unit_float(b.x), unit_float(b.y)};
    }
    /// A plain random number in [0, 1), from a separate stream.
    float random(uint32_t reversed_sample, uint32_t index) const {
        return unit_float(hash_bits(hash_bits(reversed_sample + seed_b) ^ hash_bits(seed_a + 0xc2b2ae35u * index)));
    }
};
