#include "core/gpu/pass_graph.h"

#include "core/error.h"
#include "core/gpu/device.h"
#include "core/gpu/format.h"
#include "core/gpu/pipeline.h"
#include "core/gpu/resources.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstring>
#include <map>
#include <optional>

namespace {

// The uniform buffer: the camera block, then the parameters at an offset that suits every device's alignment (256 at most).
constexpr size_t params_offset = 2048, uniforms_size = 6144;
static_assert(sizeof(CameraData) <= params_offset);
constexpr uint32_t max_stages = 2048;  // per frame, on a GPU: two time stamps each

const ParameterSet no_parameters;

vk::SamplerAddressMode address_mode(Wrap wrap) {
    switch (wrap) {
    case Wrap::clamp: return vk::SamplerAddressMode::eClampToEdge;
    case Wrap::repeat: return vk::SamplerAddressMode::eRepeat;
    case Wrap::mirrored_repeat: return vk::SamplerAddressMode::eMirroredRepeat;
    }
    fail("no address mode for Wrap ", int(wrap));
}

vk::CullModeFlags cull_mode(Draw::Cull cull) {
    return cull == Draw::Cull::back ? vk::CullModeFlagBits::eBack : cull == Draw::Cull::front ? vk::CullModeFlagBits::eFront : vk::CullModeFlagBits::eNone;
}

std::string stage_of(const std::string& shader) { return shader.substr(0, shader.rfind('.')); }

}  // namespace

struct PassGraph::Impl {
    Device& device;
    Device::Impl& gpu;
    glm::uvec2 extent;
    Clock clock;
    PipelineCache& pipelines;
    DeviceBuffer uniforms;
    std::map<std::string, Image> images, inputs;
    std::map<std::string, Buffer> buffers;
    unsigned parity = 0;
    const ParameterSet* params = &no_parameters;
    std::map<std::array<int, 3>, vk::raii::Sampler> samplers;

    std::vector<PassTime> times;
    double frame_milliseconds = 0;
    // On a GPU only: what has been recorded since begin_frame() or the last flush.
    vk::raii::CommandBuffer commands{nullptr};
    vk::raii::Fence fence{nullptr};
    vk::raii::QueryPool queries{nullptr};
    std::vector<std::string> recorded;

    Impl(Device& d, glm::uvec2 e, Clock c)
        : device(d), gpu(d.impl()), extent(e), clock(c), pipelines(*gpu.pipelines), uniforms(gpu, uniforms_size, vk::BufferUsageFlagBits::eUniformBuffer, true) {
        if (clock == Clock::host_fence) return;
        if (gpu.timestamp_bits == 0) fail_machine("the Vulkan device '", gpu.info.name, "' has no time stamps");
        commands = std::move(vk::raii::CommandBuffers(gpu.device, vk::CommandBufferAllocateInfo{.commandPool = *gpu.pool, .commandBufferCount = 1}).front());
        fence = {gpu.device, vk::FenceCreateInfo{}};
        queries = {gpu.device, vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp, .queryCount = 2 * max_stages}};
    }
    ~Impl() {
        try {
            flush();  // images may outlive the graph
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s\n", error.what());
        }
    }

    void execute(const std::string& stage, const std::function<void(const vk::raii::CommandBuffer&)>& record);
    void flush();
    void add_time(const std::string& stage, double milliseconds);

    const vk::raii::Sampler& sampler(const Sampling& sampling);
    void run(Pass& pass, std::optional<glm::uvec3> groups, const Buffer* arguments, size_t arguments_offset);
    void check(const Pass& pass, const ShaderInterface& interface);
    void check_features(const Image& image, ShaderInterface::Kind kind, const Sampling& sampling);
    void bind(const vk::raii::CommandBuffer& commands, const Pass& pass, const Draw* draw, const Pipeline& pipeline);
    void draw(const vk::raii::CommandBuffer& commands, const Pass& pass, const Pipeline& pipeline, const std::vector<Image>& attachments);
    [[noreturn]] void fail_missing(const Pass& pass, const std::string& name);
    const Image* find_image(const Pass& pass, const Draw* draw, const std::string& name, Sampling& sampling);
    const Buffer* find_buffer(const Pass& pass, const Draw* draw, const std::string& name);
    void write_params();
};

PassGraph::PassGraph(Device& device, glm::uvec2 extent) : PassGraph(device, extent, device.info().is_cpu() ? Clock::host_fence : Clock::gpu_timestamp) {}
PassGraph::PassGraph(Device& device, glm::uvec2 extent, Clock clock) : impl_(std::make_unique<Impl>(device, extent, clock)) {}
PassGraph::~PassGraph() = default;

Clock PassGraph::clock() const { return impl_->clock; }
glm::uvec2 PassGraph::extent() const { return impl_->extent; }
Device& PassGraph::device() { return impl_->device; }

// --- Resources ---

Image PassGraph::image(const std::string& name, Format format, unsigned mips, unsigned divisor) { return image_of(name, format, max(impl_->extent / divisor, 1u), mips); }

Image PassGraph::image_of(const std::string& name, Format format, glm::uvec2 extent, unsigned mips) {
    if (extent.x == 0 || extent.y == 0) fail("image '", name, "' has zero size");
    const auto [entry, is_new] = impl_->images.try_emplace(name);
    Image& image = entry->second;
    if (is_new || image.format != format || image.extent != extent || image.mips != mips) {
        impl_->flush();  // recorded passes may use the one that it replaces
        image = {.name = name, .format = format, .extent = extent, .mips = mips, .storage = create_image(impl_->gpu, format, extent, mips)};
    }
    return image;
}

Buffer PassGraph::buffer(const std::string& name, size_t bytes) {
    if (bytes == 0 || bytes % 4) fail("buffer '", name, "' has ", bytes, " bytes; it takes a positive multiple of 4");
    const auto [entry, is_new] = impl_->buffers.try_emplace(name);
    if (is_new || entry->second.size != bytes) {
        impl_->flush();
        entry->second = {.name = name, .size = bytes, .storage = create_buffer(impl_->gpu, bytes)};
    }
    return entry->second;
}

PassGraph::History PassGraph::history(const std::string& name, Format format) {
    const auto side = [&](unsigned parity) {
        const std::string full_name = name + "#" + std::to_string(parity);
        const bool is_new = !impl_->images.contains(full_name);
        const Image image = this->image(full_name, format);
        if (is_new) clear(image, glm::vec4(0.0f));
        return image;
    };
    const Image sides[2] = {side(0), side(1)};
    return {sides[impl_->parity].as(name), sides[1 - impl_->parity].as("previous_" + name)};
}

void PassGraph::clear(const Image& image, glm::vec4 value) {
    impl_->execute("clear", [&](const auto& commands) {
        const ImageStorage& storage = *image.storage;
        const vk::ImageSubresourceRange range{storage.aspect, image.first_mip, image.mips, 0, 1};
        if (storage.aspect & vk::ImageAspectFlagBits::eDepth) {
            commands.clearDepthStencilImage(*storage.image, vk::ImageLayout::eGeneral, vk::ClearDepthStencilValue{value.x, uint32_t(value.y)}, range);
        } else {
            const VkClearColorValue integer{.uint32 = {uint32_t(value.x), 0, 0, 0}}, real{.float32 = {value.x, value.y, value.z, value.w}};
            const VkClearColorValue& chosen = image.format == Format::r32ui ? integer : real;
            const auto color = std::bit_cast<vk::ClearColorValue>(chosen);
            commands.clearColorImage(*storage.image, vk::ImageLayout::eGeneral, color, range);
        }
    });
    image.storage->is_written = true;
}

void PassGraph::clear(const Buffer& buffer, uint32_t value) {
    impl_->execute("clear", [&](const auto& commands) { commands.fillBuffer(*buffer.storage->buffer.buffer, 0, VK_WHOLE_SIZE, value); });
}

void PassGraph::upload(const Image& image, const HostImage& pixels) {
    const TexelLayout layout = texel_layout(image.format);
    if (pixels.extent != image.extent || pixels.channels != layout.channels)
        fail("image '", image.name, "' is ", image.extent.x, "x", image.extent.y, " with ", layout.channels, " channels and cannot take ", pixels.extent.x, "x", pixels.extent.y, " with ", pixels.channels);
    std::vector<std::byte> texels(pixels.pixel_count() * layout.bytes);
    encode_texels(image.format, pixels.values, texels.data());
    impl_->flush();
    upload_texels(impl_->gpu, image, texels);
}

void PassGraph::upload_rgba8(const Image& image, std::span<const uint8_t> texels) {
    if (texels.size() != size_t(image.extent.x) * image.extent.y * 4) fail("image '", image.name, "' takes ", size_t(image.extent.x) * image.extent.y * 4, " bytes, not ", texels.size());
    impl_->flush();
    upload_texels(impl_->gpu, image, std::as_bytes(texels));
}

void PassGraph::upload(const Buffer& buffer, std::span<const std::byte> bytes) {
    if (bytes.size() > buffer.size) fail("buffer '", buffer.name, "' holds ", buffer.size, " bytes, not ", bytes.size());
    impl_->flush();
    upload_bytes(impl_->gpu, buffer, bytes);
}

HostImage PassGraph::download(const Image& image) {
    impl_->flush();
    const std::vector<std::byte> texels = download_texels(impl_->gpu, image);
    HostImage pixels(image.extent, texel_layout(image.format).channels);
    decode_texels(image.format, texels.data(), pixels.values);
    return pixels;
}

std::vector<std::byte> PassGraph::download(const Buffer& buffer) {
    impl_->flush();
    return download_bytes(impl_->gpu, buffer);
}

// --- Frames and time ---

void PassGraph::begin_frame(const CameraData& camera, const ParameterSet& params, std::span<const Image> inputs) {
    impl_->flush();
    impl_->times.clear();
    impl_->frame_milliseconds = 0;
    impl_->parity = 1 - impl_->parity;
    impl_->params = &params;
    impl_->inputs.clear();
    for (const Image& image : inputs) impl_->inputs[image.name] = image;
    std::memcpy(impl_->uniforms.data, &camera, sizeof camera);
    impl_->write_params();
}

void PassGraph::Impl::write_params() {
    size_t offset = params_offset;  // std140 packs scalars one after the other
    for (const Parameter& p : *params)
        if (p.use == Use::uniform) {
            if (offset + 4 > uniforms_size) fail("more than ", (uniforms_size - params_offset) / 4, " uniform parameters");
            const uint32_t bits = p.bits();
            std::memcpy(uniforms.data + offset, &bits, 4);
            offset += 4;
        }
}

std::vector<PassTime> PassGraph::times() {
    impl_->flush();
    return impl_->times;
}

double PassGraph::frame_milliseconds() {
    impl_->flush();
    return impl_->frame_milliseconds;
}

void PassGraph::Impl::add_time(const std::string& stage, double milliseconds) {
    const auto found = std::ranges::find(times, stage, &PassTime::stage);
    if (found == times.end())
        times.push_back({stage, milliseconds});
    else
        found->milliseconds += milliseconds;
}

void PassGraph::Impl::execute(const std::string& stage, const std::function<void(const vk::raii::CommandBuffer&)>& record) {
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
        full_barrier(gpu.commands);
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
    full_barrier(commands);
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *queries, query + 1);
    recorded.push_back(stage);
}

void PassGraph::Impl::flush() {
    if (recorded.empty()) return;
    gpu.flush_recording = nullptr;
    commands.end();
    const std::vector<std::string> stages = std::exchange(recorded, {});
    gpu.submit_and_wait(commands, fence);
    auto [result, ticks] = queries.getResults<uint64_t>(0, uint32_t(2 * stages.size()), 2 * stages.size() * sizeof(uint64_t), sizeof(uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    if (result != vk::Result::eSuccess) fail_machine("the Vulkan device '", gpu.info.name, "' gave no time stamps");
    const double milliseconds_per_tick = gpu.nanoseconds_per_tick * 1e-6;
    if (gpu.timestamp_bits < 64)
        for (uint64_t& tick : ticks) tick &= (uint64_t(1) << gpu.timestamp_bits) - 1;
    for (size_t i = 0; i < stages.size(); ++i) add_time(stages[i], double(ticks[2 * i + 1] - ticks[2 * i]) * milliseconds_per_tick);
    frame_milliseconds += double(ticks.back() - ticks.front()) * milliseconds_per_tick;
}

// --- Passes ---

PassGraph::Pass::Pass(PassGraph::Impl& graph, std::string shader, bool is_compute) : graph_(graph), shader_(std::move(shader)), label_(stage_of(shader_)), is_compute_(is_compute) {}

PassGraph::Pass PassGraph::compute(const std::string& shader) { return {*impl_, shader, true}; }
PassGraph::Pass PassGraph::fragment(const std::string& shader) { return {*impl_, shader, false}; }
PassGraph::Pass PassGraph::draw(const std::string& vertex_shader, const std::string& fragment_shader, std::vector<Draw> draws) {
    Pass pass{*impl_, fragment_shader, false};
    pass.vertex_shader_ = vertex_shader;
    pass.draws_ = std::move(draws);
    return pass;
}

PassGraph::Pass& PassGraph::Pass::read(const Image& image, Sampling sampling) { return reads_.push_back({image, sampling}), *this; }
PassGraph::Pass& PassGraph::Pass::write(const Image& image) { return writes_.push_back(image), *this; }
PassGraph::Pass& PassGraph::Pass::use(const Buffer& buffer) { return buffers_.push_back(buffer), *this; }
PassGraph::Pass& PassGraph::Pass::stencil(Stencil stencil) { return stencil_ = std::move(stencil), *this; }
PassGraph::Pass& PassGraph::Pass::depth(DepthTest test) { return depth_ = std::move(test), *this; }
PassGraph::Pass& PassGraph::Pass::label(std::string stage) { return label_ = std::move(stage), *this; }
PassGraph::Pass& PassGraph::Pass::set(const std::string& name, float value) { return pushes_.push_back({name, {value}, 4}), *this; }
PassGraph::Pass& PassGraph::Pass::set(const std::string& name, int value) { return pushes_.push_back({name, {std::bit_cast<float>(value)}, 4}), *this; }
PassGraph::Pass& PassGraph::Pass::set(const std::string& name, unsigned value) { return pushes_.push_back({name, {std::bit_cast<float>(value)}, 4}), *this; }
PassGraph::Pass& PassGraph::Pass::set(const std::string& name, glm::vec4 value) { return pushes_.push_back({name, {value.x, value.y, value.z, value.w}, 16}), *this; }

void PassGraph::Pass::run() {
    if (!is_compute_) return graph_.run(*this, {}, nullptr, 0);
    if (writes_.empty()) fail("pass ", label_, " writes no image, so run() needs an extent");
    run(writes_.front().extent);
}

void PassGraph::Pass::run(glm::uvec2 extent) {
    const auto local = graph_.pipelines.shader(shader_, vertex_shader_, *graph_.params).interface.local_size;
    dispatch_groups({(extent.x + local[0] - 1) / local[0], (extent.y + local[1] - 1) / local[1], 1});
}

void PassGraph::Pass::dispatch_groups(glm::uvec3 groups) { graph_.run(*this, groups, nullptr, 0); }
void PassGraph::Pass::dispatch(const Buffer& arguments, size_t offset) { graph_.run(*this, {}, &arguments, offset); }

const vk::raii::Sampler& PassGraph::Impl::sampler(const Sampling& s) {
    const auto [entry, is_new] = samplers.try_emplace({int(s.is_linear), int(s.wrap_u), int(s.wrap_v)}, nullptr);
    const vk::Filter filter = s.is_linear ? vk::Filter::eLinear : vk::Filter::eNearest;
    if (is_new)
        entry->second = {gpu.device, vk::SamplerCreateInfo{.magFilter = filter, .minFilter = filter, .mipmapMode = s.is_linear ? vk::SamplerMipmapMode::eLinear : vk::SamplerMipmapMode::eNearest,
                                                           .addressModeU = address_mode(s.wrap_u), .addressModeV = address_mode(s.wrap_v), .maxLod = VK_LOD_CLAMP_NONE}};
    return entry->second;
}

const Image* PassGraph::Impl::find_image(const Pass& pass, const Draw* draw, const std::string& name, Sampling& sampling) {
    for (const std::vector<Read>* reads : {draw ? &draw->reads : nullptr, &pass.reads_}) {
        if (!reads) continue;
        for (const Read& read : *reads)
            if (read.image.name == name) {
                sampling = read.sampling;
                return &read.image;
            }
    }
    for (const Image& image : pass.writes_)
        if (image.name == name) return &image;
    const auto input = inputs.find(name);
    return input == inputs.end() ? nullptr : &input->second;
}

const Buffer* PassGraph::Impl::find_buffer(const Pass& pass, const Draw* draw, const std::string& name) {
    for (const std::vector<Buffer>* buffers : {draw ? &draw->buffers : nullptr, &pass.buffers_}) {
        if (!buffers) continue;
        for (const Buffer& buffer : *buffers)
            if (buffer.name == name) return &buffer;
    }
    return nullptr;
}

void PassGraph::Impl::fail_missing(const Pass& pass, const std::string& name) {
    std::vector<std::string> provided;
    for (const Read& read : pass.reads_) provided.push_back(read.image.name);
    for (const Image& image : pass.writes_) provided.push_back(image.name);
    for (const Buffer& buffer : pass.buffers_) provided.push_back(buffer.name);
    for (const auto& [input, _] : inputs) provided.push_back(input);
    std::ranges::sort(provided);
    std::string list;
    for (const std::string& p : provided) list += " " + p;
    fail(pass.shader_, " uses '", name, "', which the pass does not provide; it provides:", list);
}

/// What a pass names and its shader ignores is a mistake, and so is reading what nobody has written.
void PassGraph::Impl::check(const Pass& pass, const ShaderInterface& interface) {
    const auto is_used = [&](const std::string& name) {
        return interface.outputs.contains(name) || std::ranges::any_of(interface.resources, [&](const auto& r) { return r.name == name; });
    };
    for (const Read& read : pass.reads_)
        if (!is_used(read.image.name)) fail("pass ", pass.label_, " reads '", read.image.name, "', which ", pass.shader_, " does not use");
    for (const Image& image : pass.writes_)
        if (!is_used(image.name)) fail("pass ", pass.label_, " writes '", image.name, "', which ", pass.shader_, " does not use");
    for (const Buffer& buffer : pass.buffers_)
        if (!is_used(buffer.name)) fail("pass ", pass.label_, " uses buffer '", buffer.name, "', which ", pass.shader_, " does not use");
    for (const auto& push : pass.pushes_)
        if (!interface.push_offsets.contains(push.name)) fail("pass ", pass.label_, " sets '", push.name, "', which is no member of the push_constant block of ", pass.shader_);
}

/// Not every device filters or stores every format.
void PassGraph::Impl::check_features(const Image& image, ShaderInterface::Kind kind, const Sampling& sampling) {
    using Feature = vk::FormatFeatureFlagBits;
    const vk::FormatFeatureFlags features = image.storage->features;
    const char* missing = kind == ShaderInterface::Kind::image ? (features & Feature::eStorageImage ? nullptr : "write it from shaders")
                          : sampling.is_linear && !(features & Feature::eSampledImageFilterLinear) ? "filter it" : nullptr;
    if (missing) fail_machine("image '", image.name, "' has the format ", vk::to_string(vulkan_format(image.format)), ", and the Vulkan device '", gpu.info.name, "' cannot ", missing);
}

void PassGraph::Impl::bind(const vk::raii::CommandBuffer& commands, const Pass& pass, const Draw* draw, const Pipeline& pipeline) {
    using Kind = ShaderInterface::Kind;
    std::vector<vk::DescriptorImageInfo> image_infos;
    std::vector<vk::DescriptorBufferInfo> buffer_infos;
    image_infos.reserve(pipeline.interface.resources.size());  // writes keep pointers into both
    buffer_infos.reserve(pipeline.interface.resources.size());
    std::vector<vk::WriteDescriptorSet> writes;
    for (const auto& r : pipeline.interface.resources) {
        vk::WriteDescriptorSet write{.dstBinding = r.binding, .descriptorCount = 1};
        if (r.kind == Kind::uniforms) {
            const bool is_camera = r.name == "Camera";
            if (!is_camera && r.name != "Params") fail(pass.shader_, " declares the uniform block '", r.name, "'; use a push_constant block or a parameter");
            buffer_infos.push_back({*uniforms.buffer, is_camera ? 0 : params_offset, is_camera ? params_offset : uniforms_size - params_offset});
            write.descriptorType = vk::DescriptorType::eUniformBuffer;
            write.pBufferInfo = &buffer_infos.back();
        } else if (r.kind == Kind::storage) {
            const Buffer* buffer = find_buffer(pass, draw, r.name);
            if (!buffer) fail_missing(pass, r.name);
            buffer_infos.push_back({*buffer->storage->buffer.buffer, 0, VK_WHOLE_SIZE});
            write.descriptorType = vk::DescriptorType::eStorageBuffer;
            write.pBufferInfo = &buffer_infos.back();
        } else {
            Sampling sampling;
            const Image* image = find_image(pass, draw, r.name, sampling);
            if (!image) fail_missing(pass, r.name);
            const bool is_sampled = r.kind == Kind::sampler;
            if (is_sampled && !image->storage->is_written) fail("pass ", pass.label_, " reads '", r.name, "', which nothing has written yet");
            check_features(*image, r.kind, sampling);
            const bool is_one_mip = !is_sampled || image->mips == 1;
            const vk::ImageView view = is_one_mip ? *image->storage->mips[image->first_mip] : *image->storage->whole;
            image_infos.push_back({is_sampled ? *sampler(sampling) : vk::Sampler{}, view, vk::ImageLayout::eGeneral});
            write.descriptorType = is_sampled ? vk::DescriptorType::eCombinedImageSampler : vk::DescriptorType::eStorageImage;
            write.pImageInfo = &image_infos.back();
        }
        writes.push_back(write);
    }
    const auto point = pipeline.is_compute ? vk::PipelineBindPoint::eCompute : vk::PipelineBindPoint::eGraphics;
    if (!writes.empty()) commands.pushDescriptorSetKHR(point, *pipeline.layout, 0, writes);
}

void PassGraph::Impl::draw(const vk::raii::CommandBuffer& commands, const Pass& pass, const Pipeline& pipeline, const std::vector<Image>& attachments) {
    const bool has_depth = bool(pass.depth_.image.storage), has_stencil = pass.stencil_.mode != Stencil::Mode::off;
    const glm::uvec2 area = !attachments.empty() ? attachments.front().extent : has_depth ? pass.depth_.image.extent : pass.stencil_.image.extent;
    const auto attachment = [](vk::ImageView view) {
        return vk::RenderingAttachmentInfo{.imageView = view, .imageLayout = vk::ImageLayout::eGeneral, .loadOp = vk::AttachmentLoadOp::eLoad, .storeOp = vk::AttachmentStoreOp::eStore};
    };
    std::vector<vk::RenderingAttachmentInfo> colors;
    for (const Image& image : attachments) {
        if (image.extent != area) fail("pass ", pass.label_, " writes '", image.name, "' of another size than '", attachments.front().name, "'");
        colors.push_back(attachment(*image.storage->mips[image.first_mip]));
    }
    const vk::RenderingAttachmentInfo depth = has_depth ? attachment(*pass.depth_.image.storage->attachment) : has_stencil ? attachment(*pass.stencil_.image.storage->attachment) : vk::RenderingAttachmentInfo{};
    const bool has_depth_attachment = has_depth || has_stencil;
    commands.beginRendering({.renderArea = {{}, {area.x, area.y}}, .layerCount = 1, .colorAttachmentCount = uint32_t(colors.size()), .pColorAttachments = colors.data(),
                             .pDepthAttachment = has_depth_attachment ? &depth : nullptr, .pStencilAttachment = has_stencil ? &depth : nullptr});
    commands.setViewport(0, vk::Viewport{0, 0, float(area.x), float(area.y), 0, 1});
    commands.setScissor(0, vk::Rect2D{{}, {area.x, area.y}});
    if (pass.vertex_shader_.empty()) {
        commands.setCullMode(vk::CullModeFlagBits::eNone);
        bind(commands, pass, nullptr, pipeline);
        commands.draw(3, 1, 0, 0);
    }
    for (const Draw& d : pass.draws_) {
        commands.setCullMode(cull_mode(d.cull));
        bind(commands, pass, &d, pipeline);
        commands.bindIndexBuffer(*d.indices.storage->buffer.buffer, 0, vk::IndexType::eUint32);
        commands.drawIndexed(d.index_count, 1, d.first_index, d.vertex_offset, d.first_instance);
    }
    commands.endRendering();
}

void PassGraph::Impl::run(Pass& pass, std::optional<glm::uvec3> groups, const Buffer* arguments, size_t arguments_offset) {
    const Shader& shader = pipelines.shader(pass.shader_, pass.vertex_shader_, *params);
    check(pass, shader.interface);
    PipelineState state{.attachments = {}, .stencil = pass.stencil_.mode, .stencil_value = pass.stencil_.value, .has_depth = bool(pass.depth_.image.storage), .depth = pass.depth_};
    std::vector<Image> attachments;
    if (!pass.is_compute_) {
        attachments.resize(shader.interface.outputs.size());
        for (const auto& [name, location] : shader.interface.outputs) {
            const auto target = std::ranges::find(pass.writes_, name, &Image::name);
            if (target == pass.writes_.end()) fail_missing(pass, name);
            if (location >= attachments.size()) fail(pass.shader_, ": the locations of its outputs have gaps");
            attachments[location] = *target;
        }
        for (const Image& image : attachments) state.attachments.push_back(image.format);
    }
    const Pipeline& pipeline = pipelines.pipeline(pass.shader_, pass.vertex_shader_, *params, state);
    execute(pass.label_, [&](const vk::raii::CommandBuffer& commands) {
        commands.bindPipeline(pass.is_compute_ ? vk::PipelineBindPoint::eCompute : vk::PipelineBindPoint::eGraphics, *pipeline.pipeline);
        if (pipeline.interface.push_size) {
            std::vector<std::byte> block(pipeline.interface.push_size);
            for (const auto& push : pass.pushes_) std::memcpy(block.data() + pipeline.interface.push_offsets.at(push.name), push.bits.data(), push.size);
            const vk::ShaderStageFlags stages = pass.is_compute_ ? vk::ShaderStageFlagBits::eCompute : vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
            commands.pushConstants<std::byte>(*pipeline.layout, stages, 0, block);
        }
        if (!pass.is_compute_) return draw(commands, pass, pipeline, attachments);
        bind(commands, pass, nullptr, pipeline);
        if (arguments)
            commands.dispatchIndirect(*arguments->storage->buffer.buffer, arguments_offset);
        else
            commands.dispatch(groups->x, groups->y, groups->z);
    });
    for (const Image& image : pass.writes_) image.storage->is_written = true;
    for (const Image* image : {&pass.depth_.image, &pass.stencil_.image})
        if (image->storage) image->storage->is_written = true;
}
