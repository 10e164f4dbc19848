#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

// Points of the unit cube [0, 1)^dimensions, `count` of them, each a vector of `dimensions` numbers. The same arguments
// give the same points on every machine.

using UnitSamples = std::vector<std::vector<double>>;

UnitSamples random_samples(size_t count, size_t dimensions, uint32_t seed);

/// Along each axis, each of `count` equal intervals holds exactly one point (McKay, Beckman and Conover 1979).
UnitSamples latin_hypercube_samples(size_t count, size_t dimensions, uint32_t seed);

/// The first points of Sobol's sequence, shifted digitally by `seed`; direction numbers of Joe and Kuo 2008, from
/// Boost. Of the first 2^k points, every dyadic interval of an axis at least 2^-k wide holds its exact share. At most
/// 3667 dimensions.
UnitSamples sobol_samples(size_t count, size_t dimensions, uint32_t seed);
