#include "core/gpu/pass_graph_impl.h"
#include "core/gpu/resources.h"
#include "core/gpu/waves/traced_shader.h"

#include <cstring>

namespace {

// Of whole groups: their mean is known to some percent, and records of 4 kB a lane fit 128 MiB, the least that devices
// have.
constexpr unsigned traced_lanes = 1 << 15;

constexpr unsigned tile = 8;  // pixels, see TraceLayout

}  // namespace

void PassGraph::trace(TraceObserver observer) { impl_->trace_observer = std::move(observer); }

glm::uvec3 PassGraph::Impl::groups_of(std::optional<glm::uvec3> groups, const Buffer* arguments,
                                      size_t arguments_offset) {
    if (!arguments) return groups.value_or(glm::uvec3(0));
    flush();
    const std::vector<std::byte> bytes = download_bytes(gpu, *arguments);
    glm::uvec3 result;
    std::memcpy(&result, bytes.data() + arguments_offset, sizeof result);
    return result;
}

void PassGraph::Impl::run_traced(Pass& pass, const Shader& shader, const PipelineRecipe& recipe,
                                 const std::vector<Image>& attachments, glm::uvec3 groups,
                                 const std::function<void(const vk::raii::CommandBuffer&, const Pipeline&)>& record) {
    unsigned lanes = tile * tile;
    if (pass.is_compute_)
        lanes = shader.interface.local_size[0] * shader.interface.local_size[1] * shader.interface.local_size[2];
    else
        groups = {(area_of(pass, attachments) + tile - 1u) / tile, 1};

    PassTrace trace{.stage = pass.label_,
                    .recipe = simplified(recipe),
                    .layout = trace_layout(groups, lanes, traced_lanes / lanes),
                    .content = {}};
    const auto [pipeline, is_new] = traced_pipelines.try_emplace(bytes_of({trace.recipe}));
    if (is_new) {
        const PipelineRecipe with_trace = traced(trace.recipe);
        pipeline->second = make_pipeline(gpu.device, with_trace);
        pipeline->second.interface = shader.interface;
        pipeline->second.interface.resources = with_trace.resources;
    }

    const size_t bytes = bytes_of(trace.layout);
    const Buffer records{wave_trace_buffer, bytes, create_buffer(gpu, bytes)};
    flush();
    gpu.submit([&](auto& commands) { commands.fillBuffer(*records.storage->buffer.buffer, 0, VK_WHOLE_SIZE, 0); });
    upload_bytes(gpu, records, std::as_bytes(std::span(&trace.layout, 1)));
    pass.buffers_.push_back(records);
    execute(pass.label_, [&](const vk::raii::CommandBuffer& commands) { record(commands, pipeline->second); });
    flush();
    pass.buffers_.pop_back();
    const std::vector<std::byte> content = download_bytes(gpu, records);
    trace.content.resize(bytes / 4);
    std::memcpy(trace.content.data(), content.data(), bytes);
    trace_observer(trace);
}
