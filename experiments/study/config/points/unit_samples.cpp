#include "experiments/study/config/points/unit_samples.h"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <numeric>
#include <random>

namespace {

/// The distributions of the standard library differ from one implementation to another, the engine's bits do not.
double unit(uint64_t bits) { return double(bits >> 11) * 0x1p-53; }

std::vector<size_t> random_order(size_t count, std::mt19937_64& engine) {
    std::vector<uint64_t> keys(count);
    std::ranges::generate(keys, std::ref(engine));
    std::vector<size_t> order(count);
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, {}, [&](size_t i) { return keys[i]; });
    return order;
}

UnitSamples samples_from(size_t count, size_t dimensions, auto number) {
    UnitSamples samples(count, std::vector<double>(dimensions));
    for (size_t i = 0; i < count; ++i)
        for (size_t axis = 0; axis < dimensions; ++axis) samples[i][axis] = number(i, axis);
    return samples;
}

}  // namespace

UnitSamples random_samples(size_t count, size_t dimensions, uint32_t seed) {
    std::mt19937_64 engine(seed);
    return samples_from(count, dimensions, [&](size_t, size_t) { return unit(engine()); });
}

UnitSamples latin_hypercube_samples(size_t count, size_t dimensions, uint32_t seed) {
    std::mt19937_64 engine(seed);
    std::vector<std::vector<size_t>> intervals(dimensions);
    for (auto& order : intervals) order = random_order(count, engine);
    return samples_from(count, dimensions, [&](size_t i, size_t axis) {
        return (double(intervals[axis][i]) + unit(engine())) / double(count);
    });
}

UnitSamples sobol_samples(size_t count, size_t dimensions, uint32_t seed) {
    std::mt19937_64 engine(seed);
    std::vector<uint64_t> shift(dimensions);
    std::ranges::generate(shift, std::ref(engine));
    boost::random::sobol sequence(dimensions);
    // Boost leaves out the sequence's first point, 0, without which the shares of the first 2^k are not exact.
    return samples_from(count, dimensions,
                        [&](size_t i, size_t axis) { return unit((i == 0 ? 0 : sequence()) ^ shift[axis]); });
}
