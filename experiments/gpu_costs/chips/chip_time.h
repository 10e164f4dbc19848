#pragma once
#include "experiments/gpu_costs/chips/machine_code.h"
#include "experiments/gpu_costs/pass_cost.h"

/// The work of a stage of a frame for a chip, over all of its waves.
struct StageWork {
    ChipWork work;
    double waves = 0;
    double resident_latency = 0;  ///< sum over all waves of latency / waves of the SIMD
    double wave_latency = 0;      ///< clocks of one wave of each pass, one after another

    /// The same number of waves, each with `factor` times the work; wave_latency stays.
    StageWork times(double factor) const;
};

/// How long each part of a chip is busy with a stage if nothing else delays it, in microseconds. README.md states the
/// assumptions. The stage takes at least the longest of them.
struct ChipTime {
    double vector = 0;         ///< vector arithmetic
    double scalar = 0;         ///< scalar instructions
    double shared_memory = 0;  ///< the workgroup's memory
    double textures = 0;       ///< loads, samples and stores of images, words of buffers
    double targets = 0;        ///< writes to colour targets
    double memory = 0;         ///< each byte once (PassCost::unique_bytes), from the last cache as far as it holds them
    double latency = 0;        ///< waiting waves, as many at a time as registers allow
    /// Every requested byte through the last cache. An overestimate, since inner caches hold some: it bounds no stage.
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

/// Whether the stage waits longer for a single wave than its SIMDs wait for all of theirs.
bool is_of_one_wave(const StageWork& stage, const ChipRates& rates);

/// The part that takes longest.
const ChipTimePart& bound_of(const ChipTime& times);

/// `cost`: counts of the stage's shaders.
ChipTime chip_time(const StageWork& stage, const PassCost& cost, const ChipRates& rates);
