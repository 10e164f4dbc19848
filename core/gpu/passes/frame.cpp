#include "core/gpu/passes/pass_list_impl.h"
#include "core/gpu/resources.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <set>

namespace {

constexpr uint32_t max_stages = 2048;  // per frame, on a GPU: two time stamps each

}  // namespace

PassList::Impl::Impl(Device& d, glm::uvec2 e, Clock c)
    : device(d),
      gpu(d.impl()),
      extent(e),
      clock(c),
      pipelines(PipelineCache::of(gpu)),
      uniforms(gpu, uniforms_size, vk::BufferUsageFlagBits::eUniformBuffer, true) {
    if (clock == Clock::host_fence) return;
    if (gpu.timestamp_bits == 0) fail_machine("the Vulkan device '", gpu.info.name, "' has no time stamps");
    commands = std::move(vk::raii::CommandBuffers(gpu.device, vk::CommandBufferAllocateInfo{.commandPool = *gpu.pool,
                                                                                            .commandBufferCount = 1})
                             .front());
    fence = {gpu.device, vk::FenceCreateInfo{}};
    queries = {gpu.device,
               vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp, .queryCount = 2 * max_stages}};
}

PassList::Impl::~Impl() {
    try {
        flush();  // images may outlive the pass_list
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
}

void PassList::begin_frame(const CameraData& camera, const ParameterSet& params, std::span<const Image> inputs) {
    impl_->flush();
    impl_->times.clear();
    impl_->frame_milliseconds = 0;
    impl_->parity = 1 - impl_->parity;
    impl_->params_of_frame.clear();
    set_params(params);
    impl_->constants.clear();
    set_inputs(inputs);
    std::memcpy(impl_->uniforms.data, &camera, sizeof camera);
    if (impl_->watcher) impl_->watcher->begin_frame();
}

void PassList::set_params(const ParameterSet& params) {
    impl_->params = &params;
    if (std::ranges::count(impl_->params_of_frame, &params)) return;
    if (impl_->params_of_frame.size() == max_params_of_frame)
        fail("more than ", max_params_of_frame, " sets of parameters in one frame");
    impl_->params_of_frame.push_back(&params);
    impl_->write_params();
}

const ParameterSet& PassList::params() const { return *impl_->params; }

void PassList::set_constants(Constants constants) { impl_->constants = std::move(constants); }

void PassList::set_inputs(std::span<const Image> inputs) {
    impl_->inputs.clear();
    for (const Image& image : inputs) impl_->inputs[image.name] = image;
}

size_t PassList::Impl::params_place() const {
    const auto found = std::ranges::find(params_of_frame, params);
    return params_offset + params_size * size_t(found - params_of_frame.begin());
}

void PassList::Impl::write_params() {
    size_t offset = params_place();  // std140 packs scalars one after the other
    const size_t end = offset + params_size;
    for (const Parameter& p : *params)
        if (p.use == Use::uniform) {
            if (offset + 4 > end) fail("more than ", params_size / 4, " uniform parameters");
            const uint32_t bits = p.bits();
            std::memcpy(uniforms.data + offset, &bits, 4);
            offset += 4;
        }
}

std::vector<PassTime> PassList::times() {
    impl_->flush();
    return impl_->times;
}

double PassList::frame_milliseconds() {
    impl_->flush();
    return impl_->frame_milliseconds;
}

void PassList::Impl::add_time(const std::string& stage, double milliseconds) {
    const auto found = std::ranges::find(times, stage, &PassTime::stage);
    if (found == times.end())
        times.push_back({stage, milliseconds});
    else
        found->milliseconds += milliseconds;
}

/// One barrier in front of each stage, which holds for all that was submitted before: a stage starts when the one
/// before has ended, so that its time is its own.
void PassList::Impl::execute(const std::string& stage,
                             const std::function<void(const vk::raii::CommandBuffer&)>& record) {
    if (recorded.empty() && gpu.flush_recording) gpu.flush_recording();
    if (clock == Clock::host_fence) {
        gpu.commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        full_barrier(gpu.commands);
        try {
            record(gpu.commands);
        } catch (...) {
            gpu.commands.reset();
            throw;
        }
        gpu.commands.end();
        const auto start = std::chrono::steady_clock::now();
        gpu.submit_and_wait(gpu.commands, gpu.fence);
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        add_time(stage, time.count());
        frame_milliseconds += time.count();
        return;
    }
    if (recorded.size() == max_stages) flush();
    if (recorded.empty()) {
        commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        commands.resetQueryPool(*queries, 0, 2 * max_stages);
        gpu.flush_recording = [this] { flush(); };
    }
    const uint32_t query = uint32_t(2 * recorded.size());
    full_barrier(commands);
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *queries, query);
    try {
        record(commands);
    } catch (...) {
        commands.reset();
        recorded.clear();
        gpu.flush_recording = nullptr;
        throw;
    }
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *queries, query + 1);
    recorded.push_back(stage);
}

void PassList::Impl::flush() {
    if (recorded.empty()) return;
    gpu.flush_recording = nullptr;
    commands.end();
    const std::vector<std::string> stages = std::exchange(recorded, {});
    try {
        gpu.submit_and_wait(commands, fence);
    } catch (const MachineError& e) {
        std::string names;
        for (const std::string& stage : std::set(stages.begin(), stages.end())) names += " " + stage;
        fail_machine(e.what(), "; its stages were:", names);
    }
    auto [result, ticks] =
        queries.getResults<uint64_t>(0, uint32_t(2 * stages.size()), 2 * stages.size() * sizeof(uint64_t),
                                     sizeof(uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    if (result != vk::Result::eSuccess) fail_machine("the Vulkan device '", gpu.info.name, "' gave no time stamps");
    const double milliseconds_per_tick = gpu.nanoseconds_per_tick * 1e-6;
    if (gpu.timestamp_bits < 64)
        for (uint64_t& tick : ticks) tick &= (uint64_t(1) << gpu.timestamp_bits) - 1;
    for (size_t i = 0; i < stages.size(); ++i)
        add_time(stages[i], double(ticks[2 * i + 1] - ticks[2 * i]) * milliseconds_per_tick);
    frame_milliseconds += double(ticks.back() - ticks.front()) * milliseconds_per_tick;
}
