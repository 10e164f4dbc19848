#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

/// Owen-scrambled Sobol' points, padded: every pair of dimensions is its own randomisation of the first two Sobol' dimensions,
/// which form a (0, 2)-sequence. Counter-based: a pair is a function of (seed, pair index, sample index) and nothing else.
/// Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4).

inline uint32_t reverse_bits(uint32_t x) {
    x = __builtin_bswap32(x);
    x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
    x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
    return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
}

/// Laine and Karras 2011's permutation with Burley's constants: each bit is flipped by a hash of the bits below it, so that
/// between two bit reversals it is an Owen scramble.
inline uint32_t laine_karras(uint32_t x, uint32_t seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

/// Finaliser of MurmurHash3 (Appleby), variant 13 of Stafford: a bijection whose output bits look independent.
inline uint64_t mix_bits(uint64_t x) {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ x >> 27) * 0x94d049bb133111ebull;
    return x ^ x >> 31;
}

/// Second Sobol' dimension, bit-reversed, for each byte of the sample index: the point is the XOR of four entries.
constexpr std::array<std::array<uint32_t, 256>, 4> make_sobol_bytes() {
    std::array<uint32_t, 32> reversed_direction{};
    uint32_t direction = 0x80000000u;
    for (unsigned bit = 0; bit < 32; ++bit, direction ^= direction >> 1)
        for (unsigned i = 0; i < 32; ++i) reversed_direction[bit] |= (direction >> i & 1u) << (31 - i);
    std::array<std::array<uint32_t, 256>, 4> bytes{};
    for (unsigned byte = 0; byte < 4; ++byte)
        for (unsigned value = 0; value < 256; ++value)
            for (unsigned bit = 0; bit < 8; ++bit)
                if (value >> bit & 1u) bytes[byte][value] ^= reversed_direction[8 * byte + bit];
    return bytes;
}
inline constexpr auto sobol_bytes = make_sobol_bytes();

/// [0, 1) from the upper 24 bits.
inline float unit_float(uint32_t bits) { return float(bits >> 8) * 0x1p-24f; }

/// One point of the sequence: all pairs of one sample.
class SobolPoint {
public:
    SobolPoint(uint64_t seed, uint32_t sample) : seed_(seed), reversed_sample_(reverse_bits(sample)) {}

    /// 32-bit fixed-point coordinates of pair `pair`.
    glm::uvec2 bits(uint32_t pair) const {
        const uint64_t key = mix_bits(seed_ + 0x9e3779b97f4a7c15ull * (pair + 1));
        const uint32_t shuffle = uint32_t(key), scramble = uint32_t(key >> 32);
        const uint32_t index = reverse_bits(laine_karras(reversed_sample_, shuffle));
        const uint32_t reversed_y = sobol_bytes[0][index & 255] ^ sobol_bytes[1][index >> 8 & 255] ^
                                    sobol_bytes[2][index >> 16 & 255] ^ sobol_bytes[3][index >> 24];
        return {reverse_bits(laine_karras(index, scramble)), reverse_bits(laine_karras(reversed_y, scramble * 0x9e3779b1u + shuffle))};
    }
    glm::vec2 pair(uint32_t index) const {
        const glm::uvec2 b = bits(index);
        return {unit_float(b.x), unit_float(b.y)};
    }
    /// A number that is merely random, in a stream of its own.
    float random(uint32_t index) const {
        return unit_float(uint32_t(mix_bits((seed_ ^ 0xd1b54a32d192ed03ull) + 0x9e3779b97f4a7c15ull * (uint64_t(reversed_sample_) << 16 | index)) >> 32));
    }

private:
    uint64_t seed_;
    uint32_t reversed_sample_;
};
