#include "experiments/results/tradeoff/numpy_random.h"

#include <bit>
#include <cmath>
#include <numbers>

namespace {

/// The eight words that a SeedSequence makes of one word of entropy.
std::array<uint32_t, 8> seed_words(uint32_t entropy) {
    uint32_t constant = 0x43b0d7e5;
    const auto hashed = [&](uint32_t value) {
        value ^= constant, constant *= 0x931e8875, value *= constant;
        return value ^ (value >> 16);
    };
    std::array<uint32_t, 4> pool{};
    for (uint32_t& word : pool) word = hashed(&word == &pool[0] ? entropy : 0);
    for (size_t from = 0; from < pool.size(); ++from)
        for (size_t to = 0; to < pool.size(); ++to) {
            if (from == to) continue;
            const uint32_t mixed = 0xca01f9dd * pool[to] - 0x4973f715 * hashed(pool[from]);
            pool[to] = mixed ^ (mixed >> 16);
        }
    std::array<uint32_t, 8> words{};
    constant = 0x8b51f9dd;
    for (size_t i = 0; i < words.size(); ++i) {
        uint32_t value = pool[i % pool.size()] ^ constant;
        constant *= 0x58f38ded, value *= constant;
        words[i] = value ^ (value >> 16);
    }
    return words;
}

constexpr double tail = 3.6541528853610087963519472518;  ///< where the ziggurat's lowest layer ends

/// 256 layers of equal area below exp(-x^2 / 2): the width of each for a number of 52 bits, which of these numbers lie
/// surely below the curve, and the curve's height at its end.
struct Ziggurat {
    std::array<uint64_t, 256> inside;
    std::array<double, 256> width, height;

    Ziggurat() {
        constexpr double bits = 4503599627370496.0;
        const auto curve = [](double x) { return std::exp(-0.5 * x * x); };
        double x = tail;
        const double beyond = std::sqrt(std::numbers::pi / 2) * std::erfc(tail / std::numbers::sqrt2);
        const double area = tail * curve(tail) + beyond;
        const double lowest = area / curve(x);
        inside[0] = uint64_t(x / lowest * bits), inside[1] = 0;
        width[0] = lowest / bits, width[255] = x / bits;
        height[0] = 1, height[255] = curve(x);
        for (size_t i = 254; i > 0; --i) {
            const double above = std::sqrt(-2 * std::log(area / x + curve(x)));
            inside[i + 1] = uint64_t(above / x * bits);
            x = above, width[i] = x / bits, height[i] = curve(x);
        }
    }
};

}  // namespace

NumpyRandom::NumpyRandom(uint32_t seed) {
    const std::array<uint32_t, 8> words = seed_words(seed);
    const auto wide = [&](size_t at) {
        const auto half = [&](size_t i) { return uint64_t(words[i + 1]) << 32 | words[i]; };
        return Wide(half(at)) << 64 | half(at + 2);
    };
    increment_ = wide(4) << 1 | 1;
    next();
    state_ += wide(0);
    next();
}

uint64_t NumpyRandom::next() {
    state_ = state_ * (Wide(2549297995355413924u) << 64 | 4865540595714422341u) + increment_;
    return std::rotr(uint64_t(state_ >> 64) ^ uint64_t(state_), int(state_ >> 122));
}

double NumpyRandom::uniform() { return double(next() >> 11) * 0x1p-53; }

double NumpyRandom::normal() {
    static const Ziggurat ziggurat;
    while (true) {
        const uint64_t drawn = next(), number = drawn >> 9 & 0x000fffffffffffff;
        const size_t layer = drawn & 0xff;
        const double x = double(number) * ziggurat.width[layer] * (drawn >> 8 & 1 ? -1 : 1);
        if (number < ziggurat.inside[layer]) return x;
        if (layer > 0) {
            const double step = ziggurat.height[layer - 1] - ziggurat.height[layer];
            if (step * uniform() + ziggurat.height[layer] < std::exp(-0.5 * x * x)) return x;
            continue;
        }
        while (true) {  // beyond the tail's begin (Marsaglia 1964)
            const double beyond = -std::log1p(-uniform()) / tail, height = -std::log1p(-uniform());
            if (2 * height > beyond * beyond) return number >> 8 & 1 ? -(tail + beyond) : tail + beyond;
        }
    }
}
