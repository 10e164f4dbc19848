#include "core/gpu/pass_cost.h"

#include "core/gpu/format.h"
#include "core/gpu/pass_graph_impl.h"
#include "core/gpu/resources.h"

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

}  // namespace

void PassCost::add(const PassCost& other) {
    for (const CostQuantity& quantity : cost_quantities) this->*quantity.member += other.*quantity.member;
}

void PassGraph::count_costs(bool is_counting) {
    impl_->is_counting = is_counting;
    impl_->costs.clear();
}

std::vector<PassCost> PassGraph::costs() const { return impl_->costs; }

void PassGraph::Impl::add_cost(const PassCost& cost) {
    const auto found = std::ranges::find(costs, cost.stage, &PassCost::stage);
    if (found == costs.end())
        costs.push_back(cost);
    else
        found->add(cost);
}

void PassGraph::Impl::add_clear_cost(uint64_t bytes) {
    if (is_counting) add_cost({.stage = "clear", .bytes_written = bytes, .unique_bytes = bytes});
}

void PassGraph::Impl::make_counters(Pass& pass) {
    if (shader_counts.size == 0) {
        const size_t bytes = most_shader_counters * sizeof(uint64_t);
        shader_counts = {shader_counts_buffer, bytes, create_buffer(gpu, bytes)};
        using Statistic = vk::QueryPipelineStatisticFlagBits;
        if (gpu.has_statistics)
            device_counts = {gpu.device,
                             vk::QueryPoolCreateInfo{.queryType = vk::QueryType::ePipelineStatistics,
                                                     .queryCount = 1,
                                                     .pipelineStatistics = Statistic::eComputeShaderInvocations}};
    }
    pass.buffers_.push_back(shader_counts);
}

void PassGraph::Impl::begin_counting(const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(*shader_counts.storage->buffer.buffer, 0, VK_WHOLE_SIZE, 0);
    full_barrier(commands);
    if (!*device_counts) return;
    commands.resetQueryPool(*device_counts, 0, 1);
    commands.beginQuery(*device_counts, 0, {});
}

void PassGraph::Impl::finish_counting(Pass& pass, const std::vector<ShaderCounter>& counters,
                                      const std::vector<Image>& targets) {
    flush();
    const PassCost cost = cost_of(pass, counters, targets);
    pass.buffers_.pop_back();
    if (*device_counts && pass.is_compute_) {
        const auto [result, of_device] = device_counts.getResult<uint64_t>(
            0, 1, sizeof(uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
        if (result == vk::Result::eSuccess && of_device != cost.invocations)
            fail("pass ", pass.label_, " counted ", cost.invocations, " invocations, and the Vulkan device '",
                 gpu.info.name, "' counts ", of_device);
    }
    add_cost(cost);
}

PassCost PassGraph::Impl::cost_of(const Pass& pass, const std::vector<ShaderCounter>& counters,
                                  const std::vector<Image>& targets) {
    std::array<uint64_t, most_shader_counters> counts;
    const std::vector<std::byte> bytes = download_bytes(gpu, shader_counts);
    std::memcpy(counts.data(), bytes.data(), sizeof counts);

    PassCost cost{.stage = pass.label_};
    std::map<std::string, Traffic> traffic;
    const auto image_of = [&](const std::string& name, Sampling& sampling) -> const Image& {
        // Textures of meshes differ by the draw; their format does not.
        const Image* image = find_image(pass, pass.draws_.empty() ? nullptr : &pass.draws_.front(), name, sampling);
        if (!image) fail_missing(pass, name);
        return *image;
    };
    const auto read_texels = [&](const std::string& name, uint64_t fetches, bool is_sampled, bool is_gathered) {
        Sampling sampling;
        const Image& image = image_of(name, sampling);
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
                Sampling sampling;
                const Image& image = image_of(resource, sampling);
                traffic[resource].written += count * facts_of(image.format).bytes;
                traffic[resource].size = bytes_of(image);
                break;
            }
            case What::buffer_bytes_read:
            case What::buffer_bytes_written: {
                const Buffer* buffer =
                    find_buffer(pass, pass.draws_.empty() ? nullptr : &pass.draws_.front(), resource);
                if (!buffer) fail_missing(pass, resource);
                (what == What::buffer_bytes_read ? traffic[resource].read : traffic[resource].written) += count;
                traffic[resource].size = buffer->size;
                break;
            }
        }
    }
    if (!pass.is_compute_) cost.idle = cost.invocations - completed;
    for (const Image& target : targets) {
        traffic[target.name].written += completed * facts_of(target.format).bytes;
        traffic[target.name].size = bytes_of(target);
    }
    for (const auto& [name, t] : traffic) {
        cost.bytes_read += t.read, cost.bytes_written += t.written;
        cost.unique_bytes += std::min(t.read, t.size) + std::min(t.written, t.size);
    }
    return cost;
}
