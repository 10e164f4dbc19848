#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

// Points of the unit cube [0, 1)^dimensions, `count` of them, each a vector of `dimensions` numbers. The same arguments
// give the same points on every machine.

using UnitSamples = std::vector<std::vector<double>>;

UnitSamples random_samples(size_t count, size_t dimensions, uint32_t seed);

/// Of each axis every one of `count` equal intervals holds exactly one point (McKay, Beckman and Conover 1979).
UnitSamples latin_hypercube_samples(size_t count, size_t dimensions, uint32_t seed);

/// The first points of Sobol's sequence with the direction numbers of Joe and Kuo 2008, from Boost, shifted digitally
/// by `seed`: of the first 2^k every dyadic interval of an axis that is at least 2^-k wide holds its exact share. At
/// most 3667 dimensions.
UnitSamples sobol_samples(size_t count, size_t dimensions, uint32_t seed);
