#include "experiments/gpu_costs/pass_cost.h"

#include "core/error.h"
#include "core/gpu/format.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace {

using What = ShaderCounter::What;

/// That one sample reads.
uint64_t texels_of(const Image& image, const Sampling& sampling) {
    if (!sampling.is_linear) return 1;
    return image.mips > 1 ? 8 : 4;
}

/// What a pass read from one of its resources, or wrote to it.
struct Traffic {
    uint64_t read = 0, written = 0, size = 0;  ///< bytes
};

template <class Named>
const Named& find(const std::vector<Named>& all, const std::string& name, const PassRun& run) {
    const auto found = std::ranges::find(all, name, &Named::name);
    if (found == all.end()) fail("pass ", run.stage, " uses '", name, "', which it does not provide");
    return *found;
}

/// `counts`: by the places of `counters`.
PassCost cost_of(const PassRun& run, const std::vector<ShaderCounter>& counters, std::span<const uint64_t> counts) {
    PassCost cost{.stage = run.stage};
    std::map<std::string, Traffic> traffic;
    const auto read_texels = [&](const std::string& name, uint64_t fetches, bool is_sampled, bool is_gathered) {
        const bool is_stored = std::ranges::count(run.images, name, &PassRun::BoundImage::name) > 0;
        const auto& [_, image, sampling] = find(is_stored ? run.images : run.samplers, name, run);
        const uint64_t each = is_gathered ? 4 : is_sampled ? texels_of(image, sampling) : 1;
        cost.fetches += fetches, cost.texels += fetches * each;
        traffic[name].read += fetches * each * facts_of(image.format).bytes, traffic[name].size = bytes_of(image);
    };
    uint64_t completed = 0;
    for (size_t i = 0; i < counters.size(); ++i) {
        const auto& [what, resource] = counters[i];
        const uint64_t count = counts[i];
        switch (what) {
            case What::invocations:
                cost.invocations = count;
                break;
            case What::idle_invocations:
                cost.idle = count;
                break;
            case What::completed:
                completed = count;
                break;
            case What::writes:
                break;
            case What::operations:
                cost.operations = count;
                break;
            case What::shared_bytes:
                cost.shared_bytes = count;
                break;
            case What::atomics:
                cost.atomics = count;
                break;
            case What::texel_fetches:
            case What::samples:
            case What::gathers:
                read_texels(resource, count, what == What::samples, what == What::gathers);
                break;
            case What::texel_writes: {
                const Image& image = find(run.images, resource, run).image;
                traffic[resource].written += count * facts_of(image.format).bytes;
                traffic[resource].size = bytes_of(image);
                break;
            }
            case What::buffer_bytes_read:
            case What::buffer_bytes_written: {
                (what == What::buffer_bytes_read ? traffic[resource].read : traffic[resource].written) += count;
                traffic[resource].size = find(run.buffers, resource, run).size;
                break;
            }
        }
    }
    if (!run.recipe.is_compute) cost.idle = cost.invocations - completed;
    for (const Image& target : run.targets) {
        traffic[target.name].written += completed * facts_of(target.format).bytes;
        traffic[target.name].size = bytes_of(target);
    }
    for (const auto& [name, t] : traffic) {
        cost.bytes_read += t.read, cost.bytes_written += t.written;
        cost.unique_bytes += std::min(t.read, t.size) + std::min(t.written, t.size);
    }
    return cost;
}

}  // namespace

void PassCost::add(const PassCost& other) {
    for (const CostQuantity& quantity : cost_quantities) this->*quantity.member += other.*quantity.member;
}

std::optional<InstrumentedPipeline> CostCounter::before(const PassRun& run) {
    InstrumentedPipeline counted{.recipe = run.recipe,
                                 .buffer = shader_counts_buffer,
                                 .bytes = most_shader_counters * sizeof(uint64_t),
                                 .begin = {}};
    counters_ = count_in(counted.recipe.spirv.back());
    return counted;
}

void CostCounter::after(const PassRun& run, std::span<const std::byte> content) {
    std::array<uint64_t, most_shader_counters> counts;
    std::memcpy(counts.data(), content.data(), sizeof counts);
    const PassCost cost = cost_of(run, counters_, counts);
    if (run.device_invocations.value_or(cost.invocations) != cost.invocations)
        fail("pass ", run.stage, " counted ", cost.invocations, " invocations, and the Vulkan device counts ",
             *run.device_invocations);
    add(cost);
}

void CostCounter::cleared(const Image& image, glm::vec4) {
    add({.stage = "clear", .bytes_written = bytes_of(image), .unique_bytes = bytes_of(image)});
}
void CostCounter::cleared(const Buffer& buffer) {
    add({.stage = "clear", .bytes_written = buffer.size, .unique_bytes = buffer.size});
}

void CostCounter::add(const PassCost& cost) {
    const auto found = std::ranges::find(costs_, cost.stage, &PassCost::stage);
    if (found == costs_.end())
        costs_.push_back(cost);
    else
        found->add(cost);
}
