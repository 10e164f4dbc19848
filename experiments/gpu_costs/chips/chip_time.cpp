#include "experiments/gpu_costs/chips/chip_time.h"

#include <algorithm>

StageWork StageWork::times(double factor) const {
    StageWork result = *this;
    result.work = {};
    result.work.add(work, factor);
    result.resident_latency *= factor;
    return result;
}

const ChipTimePart& bound_of(const ChipTime& times) {
    return *std::ranges::max_element(chip_time_parts, {}, [&](const ChipTimePart& p) { return times.*p.member; });
}

bool is_of_one_wave(const StageWork& stage, const ChipRates& rates) {
    return stage.wave_latency > stage.resident_latency / (double(rates.units) * rates.simds);
}

ChipTime chip_time(const StageWork& stage, const PassCost& cost, const ChipRates& rates) {
    const double clocks_per_microsecond = rates.gigahertz * 1e3, simds = double(rates.units) * rates.simds;
    // Bytes of the mean texel. What is read from buffers is among them, so that a few texels would seem too large.
    const double texel = cost.texels ? std::min(16.0, double(cost.bytes_read) / double(cost.texels)) : 0;
    const double units = rates.units, bytes = double(cost.bytes_read + cost.bytes_written);
    const ChipWork& work = stage.work;
    const double load = std::max(1 / rates.loaded_lanes, texel / rates.loaded_bytes);
    const double sample = std::max(1.0, texel / rates.filtered_bytes) / rates.filtered_lanes;

    ChipTime clocks;
    clocks.vector = work.vector / simds;
    clocks.scalar = work.scalar / (units * rates.scalar);
    clocks.shared_memory = work.shared / units;
    clocks.textures = (work.loads * load + work.samples * sample + work.stores / rates.stored_lanes +
                       work.buffers / rates.buffer_lanes) /
                      units;
    clocks.targets = work.exports / rates.pixels;
    clocks.latency = is_of_one_wave(stage, rates) ? stage.wave_latency : stage.resident_latency / simds;
    clocks.caches = bytes / rates.cache_bytes;
    ChipTime time;
    for (const ChipTimePart& part : chip_time_parts) time.*part.member = clocks.*part.member / clocks_per_microsecond;
    time.caches = clocks.caches / clocks_per_microsecond;
    // What the cache in front of the memory holds is taken to be there.
    const double cached = std::min(double(cost.unique_bytes), rates.last_megabytes * 1e6);
    if (cached > 0) time.memory = cached / (rates.last_gigabytes * 1e3);
    time.memory += (double(cost.unique_bytes) - cached) / (rates.memory_gigabytes * 1e3);
    return time;
}
