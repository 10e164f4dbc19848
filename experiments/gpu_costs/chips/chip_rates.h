#pragma once
#include <optional>
#include <string>
#include <vector>

/// What a product with a chip does in a clock, as its vendor or measurements state it; README.md has every source.
/// Units are its compute units; all rates without another unit are of one of them, per clock.
struct ChipRates {
    std::string product;
    unsigned units = 0, simds = 0;  ///< SIMDs: of a unit
    double gigahertz = 0;           ///< the highest that the vendor states
    double memory_gigabytes = 0;    ///< per second, of the memory
    double last_megabytes = 0;      ///< of the cache in front of it; 0: none
    double last_gigabytes = 0;      ///< per second, of that
    double cache_bytes = 0;         ///< per clock, of the cache that all units share (L2)
    double pixels = 0;              ///< per clock, that all units together write to colour targets

    unsigned simd_lanes = 0;    ///< a wave takes its lanes / these clocks for an instruction
    double slow = 4;            ///< times as long: reciprocals, roots, logarithms, sines
    double slow_integer = 4;    ///< the same of products of 32-bit integers
    double slow_double = 16;    ///< the same of arithmetic in double
    double scalar = 0;          ///< scalar instructions
    double shared_bytes = 128;  ///< of the workgroup's memory
    double filtered_lanes = 4;  ///< samples, of texels of `filtered_bytes` at most
    double filtered_bytes = 0;  ///< more: as much longer
    double loaded_lanes = 0;    ///< image loads without a filter
    double loaded_bytes = 0;    ///< and their bytes
    double stored_lanes = 0;    ///< image stores
    double buffer_lanes = 0;    ///< loads and stores of a word
    double memory_latency = 320, scalar_latency = 30, shared_latency = 20;  ///< clocks, as compilers schedule for them
    bool waits_for_stores = false;  ///< stores are counted with loads, so that waiting for one waits for the other
};

/// Of the product that stands for a chip; empty for one without published rates here.
std::optional<ChipRates> chip_rates(const std::string& chip);

/// The chips that have some, by name.
std::vector<std::string> chips_with_rates();
