#pragma once
#include <optional>
#include <string>
#include <vector>

/// Throughput of a product with a chip, as its vendor or measurements state it; README.md names every source. A unit is
/// a compute unit. Rates without another unit are of one compute unit, per clock.
struct ChipRates {
    std::string product;
    unsigned units = 0, simds = 0;  ///< simds: of one unit
    double gigahertz = 0;           ///< the highest that the vendor states
    double memory_gigabytes = 0;    ///< per second, of the memory
    double last_megabytes = 0;      ///< cache in front of the memory; 0: none
    double last_gigabytes = 0;      ///< per second, of that cache
    double cache_bytes = 0;         ///< per clock, of the cache that all units share (L2)
    double pixels = 0;              ///< per clock, written to colour targets by all units together

    unsigned simd_lanes = 0;    ///< an instruction takes a wave's lanes / simd_lanes clocks
    double slow = 4;            ///< factor of the time of reciprocals, roots, logarithms, sines
    double slow_integer = 4;    ///< factor for products of 32-bit integers
    double slow_double = 16;    ///< factor for double arithmetic
    double scalar = 0;          ///< scalar instructions
    double shared_bytes = 128;  ///< bytes of the workgroup's memory
    double filtered_lanes = 4;  ///< filtered samples of texels of at most `filtered_bytes`
    double filtered_bytes = 0;  ///< larger texels take proportionally longer
    double loaded_lanes = 0;    ///< image loads without a filter
    double loaded_bytes = 0;    ///< bytes of these loads
    double stored_lanes = 0;    ///< image stores
    double buffer_lanes = 0;    ///< loads and stores of a word
    double memory_latency = 320, scalar_latency = 30, shared_latency = 20;  ///< clocks, as compilers schedule for them
    bool waits_for_stores = false;  ///< stores and loads share a counter: waiting for one waits for the other
};

/// The rates of the product that represents a chip; nullopt for a chip without published rates here.
std::optional<ChipRates> chip_rates(const std::string& chip);

/// The chip of a product in any common spelling ("RX 6800 XT", "rx6800xt", "Radeon RX 6800 XT"); another text is
/// returned as it is.
std::string chip_named(const std::string& text);

/// The names of the chips with rates.
std::vector<std::string> chips_with_rates();
