#pragma once
#include "experiments/gpu_costs/chips/machine_code.h"
#include "experiments/gpu_costs/pass_cost.h"

/// What a stage of a frame asks of a chip, over all of its waves.
struct StageWork {
    ChipWork work;
    double waves = 0;
    double resident_latency = 0;  ///< the sum of the latencies of all waves, each divided by the waves of its SIMD
    double wave_latency = 0;      ///< clocks that one wave of each of its passes takes, which follow each other

    /// As many waves that do `factor` times as much, but for that one.
    StageWork times(double factor) const;
};

/// How long the parts of a chip are busy with a stage if nothing else held them up, microseconds each; README.md says
/// what each assumes. The stage takes at least the longest of them.
struct ChipTime {
    double vector = 0;         ///< arithmetic of vectors
    double scalar = 0;         ///< scalar instructions
    double shared_memory = 0;  ///< the workgroup's memory
    double textures = 0;       ///< loads, samples and stores of images, words of buffers
    double targets = 0;        ///< writes to colour targets
    double memory = 0;   ///< each byte once (PassCost::unique_bytes), from the cache in front of the memory as far as
                         ///< that holds them
    double latency = 0;  ///< waves that wait, as many at a time as their registers let be
    /// Each byte that is asked for through the last cache: more than the truth, since others hold some of them. It
    /// bounds no stage.
    double caches = 0;
};

struct ChipTimePart {
    const char* name;
    double ChipTime::*member;
};
inline constexpr std::array chip_time_parts = {
    ChipTimePart{"vector", &ChipTime::vector},
    ChipTimePart{"scalar", &ChipTime::scalar},
    ChipTimePart{"shared_memory", &ChipTime::shared_memory},
    ChipTimePart{"textures", &ChipTime::textures},
    ChipTimePart{"targets", &ChipTime::targets},
    ChipTimePart{"memory", &ChipTime::memory},
    ChipTimePart{"latency", &ChipTime::latency},
};

/// Whether the stage waits for one wave longer than its SIMDs wait for all of theirs.
bool is_of_one_wave(const StageWork& stage, const ChipRates& rates);

/// The part that takes longest.
const ChipTimePart& bound_of(const ChipTime& times);

/// `cost`: what the stage's shaders count of themselves.
ChipTime chip_time(const StageWork& stage, const PassCost& cost, const ChipRates& rates);
