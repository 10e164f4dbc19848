#include "core/gpu/passes/pass_watcher.h"

#include "core/gpu/passes/pass_list_impl.h"
#include "core/gpu/resources.h"

void PassList::watch(PassWatcher* watcher) { impl_->watcher = watcher; }

void WatchedBuffer::grow(Device::Impl& gpu, size_t bytes) {
    if (bytes <= size) return;
    storage = create_buffer(gpu, bytes);
    host = DeviceBuffer(gpu, bytes, vk::BufferUsageFlagBits::eTransferDst, true);
    size = bytes;
}

std::span<const std::byte> WatchedBuffer::content(Device::Impl& gpu, size_t bytes) const {
    gpu.submit([&](auto& commands) {
        full_barrier(commands);
        commands.copyBuffer(*storage->buffer.buffer, *host.buffer, vk::BufferCopy{.size = bytes});
        full_barrier(commands);
    });
    return {host.data, bytes};
}

bool PassList::Impl::run_watched(Pass& pass, ShaderChanges changes, const PipelineState& state,
                                 const std::vector<Image>& targets, const std::function<glm::uvec3()>& groups,
                                 const Recording& record) {
    changes.is_for_gpu = true;
    if (const GlslChange* change = watcher->glsl_change()) changes.glsl.push_back(*change);
    const Shader& seen = pipelines.shader(pass.shader_, pass.vertex_shader_, *params, pass.includes_, changes);
    PassRun run{.stage = pass.label_,
                .shader = pass.shader_,
                .draws_meshes = !pass.vertex_shader_.empty(),
                .params = *params,
                .includes = pass.includes_,
                .constants = constants,
                .recipe = PipelineCache::recipe(seen, pass.shader_, *params, constants, state),
                .samplers = {},
                .images = {},
                .buffers = {},
                .targets = targets,
                .area = area_of(pass, targets),
                .groups = groups,
                .depth = pass.depth_,
                .stencil = pass.stencil_,
                .push = push_block(pass, seen.interface),
                .device_invocations = {}};
    // Textures of meshes differ by the draw; their format does not.
    const Draw* const first = pass.draws_.empty() ? nullptr : &pass.draws_.front();
    for (const ShaderInterface::Resource& r : seen.interface.resources) {
        Sampling sampling;
        const Image* const image = find_image(pass, first, r.name, sampling);
        if (image && r.kind == ShaderInterface::Kind::sampler) run.samplers.push_back({r.name, *image, sampling});
        if (image && r.kind == ShaderInterface::Kind::image) run.images.push_back({r.name, *image, sampling});
        const Buffer* const buffer = find_buffer(pass, first, r.name);
        if (buffer && r.kind == ShaderInterface::Kind::storage) run.buffers.push_back(*buffer);
    }
    const std::optional<InstrumentedPipeline> other = watcher->before(run);
    if (!other) return false;

    const auto [pipeline, is_new] = watched_pipelines.try_emplace(bytes_of({other->recipe}));
    if (is_new) {
        pipeline->second = make_pipeline(gpu.device, other->recipe);
        pipeline->second.interface = seen.interface;
        pipeline->second.interface.resources = other->recipe.resources;
    }
    flush();
    if (!gpu.watched) gpu.watched = std::make_shared<WatchedBuffer>();
    gpu.watched->grow(gpu, other->bytes);
    const Buffer buffer{other->buffer, other->bytes, gpu.watched->storage};
    gpu.submit([&](auto& commands) {
        commands.fillBuffer(*buffer.storage->buffer.buffer, 0, buffer.size, 0);
        full_barrier(commands);
    });
    upload_bytes(gpu, buffer, other->begin);
    const bool has_invocations = gpu.has_statistics && pass.is_compute_;
    using Statistic = vk::QueryPipelineStatisticFlagBits;
    if (has_invocations && !*device_counts)
        device_counts = {gpu.device,
                         vk::QueryPoolCreateInfo{.queryType = vk::QueryType::ePipelineStatistics,
                                                 .queryCount = 1,
                                                 .pipelineStatistics = Statistic::eComputeShaderInvocations}};
    pass.buffers_.push_back(buffer);
    execute(pass.label_, [&](const vk::raii::CommandBuffer& commands) {
        if (has_invocations) commands.resetQueryPool(*device_counts, 0, 1), commands.beginQuery(*device_counts, 0, {});
        record(commands, pipeline->second);
        if (has_invocations) commands.endQuery(*device_counts, 0);
    });
    flush();
    pass.buffers_.pop_back();
    if (has_invocations) {
        const auto [result, count] = device_counts.getResult<uint64_t>(
            0, 1, sizeof(uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
        if (result == vk::Result::eSuccess) run.device_invocations = count;
    }
    watcher->after(run, gpu.watched->content(gpu, buffer.size));
    return true;
}
