#include "core/gpu/pass_graph.h"

#include "core/gpu/device.h"
#include "core/error.h"
#include "core/gpu/shader.h"

#include <bit>
#include <cstring>

struct ImageStorage {
    vk::raii::Image image{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
    vk::raii::ImageView whole{nullptr};
    std::vector<vk::raii::ImageView> mips;
    vk::ImageAspectFlags aspect;
    vk::Format format{};
};

Image Image::mip(unsigned level) const {
    Image view = *this;
    view.first_mip = first_mip + level;
    view.mips = 1;
    view.extent = max(extent >> level, 1u);
    return view;
}

Image Image::as(std::string shader_name) const {
    Image view = *this;
    view.name = std::move(shader_name);
    return view;
}

namespace {

vk::Format vulkan(Format format) {
    switch (format) {
    case Format::r8: return vk::Format::eR8Unorm;
    case Format::r16f: return vk::Format::eR16Sfloat;
    case Format::rg16f: return vk::Format::eR16G16Sfloat;
    case Format::rgba16f: return vk::Format::eR16G16B16A16Sfloat;
    case Format::r32f: return vk::Format::eR32Sfloat;
    case Format::r32ui: return vk::Format::eR32Uint;
    case Format::rgba32f: return vk::Format::eR32G32B32A32Sfloat;
    case Format::depth_stencil: return vk::Format::eD32SfloatS8Uint;
    }
    fail("no Vulkan format for Format ", int(format));
}

/// A parameter as the GPU stores it: bool, int, uint and float are all four bytes wide.
uint32_t four_bytes(const Parameter& p) {
    if (p.glsl_type == "float") return std::bit_cast<uint32_t>(p.value.get<float>());
    return p.glsl_type == "bool" ? p.value.get<bool>() : p.value.get<uint32_t>();
}

const std::string camera_block = "#include \"core/shared/camera.h\"\nlayout(std140) uniform Camera { CameraData camera; };\n";

struct Pipeline {
    ShaderInterface interface;
    vk::raii::DescriptorSetLayout set{nullptr};
    vk::raii::PipelineLayout layout{nullptr};
    vk::raii::Pipeline pipeline{nullptr};
};

struct HostBuffer {
    vk::raii::Buffer buffer{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
    std::byte* data = nullptr;

    HostBuffer(const vk::raii::Device& device, size_t size, vk::BufferUsageFlags usage)
        : buffer(device, vk::BufferCreateInfo{.size = size, .usage = usage}) {
        memory = {device, vk::MemoryAllocateInfo{.allocationSize = buffer.getMemoryRequirements().size, .memoryTypeIndex = 0}};
        buffer.bindMemory(*memory, 0);
        data = static_cast<std::byte*>(memory.mapMemory(0, size));
    }
};

constexpr size_t camera_offset = 0, params_offset = 1024, uniforms_size = 2048;

}  // namespace

struct PassGraph::Impl {
    Device& gpu;
    glm::uvec2 extent;
    std::vector<std::filesystem::path> shader_roots;
    std::map<std::string, Image> images, inputs;
    std::map<std::string, Shader> shaders;
    std::map<std::string, Pipeline> pipelines;
    std::map<std::string, unsigned> history_parity;
    const ParameterSet* params = nullptr;
    std::vector<PassTime> times;
    vk::raii::Sampler nearest, linear;
    HostBuffer uniforms;

    Impl(Device& d, glm::uvec2 e, std::vector<std::filesystem::path> roots)
        : gpu(d), extent(e), shader_roots(std::move(roots)), nearest(sampler(vk::Filter::eNearest)), linear(sampler(vk::Filter::eLinear)),
          uniforms(d.device, uniforms_size, vk::BufferUsageFlagBits::eUniformBuffer) {}

    vk::raii::Sampler sampler(vk::Filter filter) {
        const auto clamp = vk::SamplerAddressMode::eClampToEdge;
        return {gpu.device, vk::SamplerCreateInfo{.magFilter = filter, .minFilter = filter, .addressModeU = clamp, .addressModeV = clamp, .maxLod = VK_LOD_CLAMP_NONE}};
    }

    Image create(std::string name, Format format, unsigned mips, unsigned divisor);
    Pipeline& pipeline(const std::string& shader, std::span<const Image> attachments, const Stencil& stencil);
    void execute(Pass& pass);
    void write_uniforms(const ShaderInterface& interface);
};

/// All images stay in the general layout: the testbed compares algorithms, and on lavapipe layouts cost nothing.
Image PassGraph::Impl::create(std::string name, Format format, unsigned mips, unsigned divisor) {
    Image image{.name = std::move(name), .format = format, .extent = max(extent / divisor, 1u), .mips = mips};
    auto storage = image.storage = std::make_shared<ImageStorage>();
    const bool is_depth = format == Format::depth_stencil;
    using Usage = vk::ImageUsageFlagBits;
    storage->format = vulkan(format);
    storage->aspect = is_depth ? vk::ImageAspectFlagBits::eDepth | vk::ImageAspectFlagBits::eStencil : vk::ImageAspectFlagBits::eColor;
    storage->image = {gpu.device, vk::ImageCreateInfo{
        .imageType = vk::ImageType::e2D, .format = storage->format, .extent = {image.extent.x, image.extent.y, 1}, .mipLevels = mips, .arrayLayers = 1,
        .usage = Usage::eTransferSrc | Usage::eTransferDst | (is_depth ? Usage::eDepthStencilAttachment : Usage::eSampled | Usage::eStorage | Usage::eColorAttachment)}};
    storage->memory = {gpu.device, vk::MemoryAllocateInfo{.allocationSize = storage->image.getMemoryRequirements().size, .memoryTypeIndex = 0}};
    storage->image.bindMemory(*storage->memory, 0);
    const auto view = [&](unsigned first, unsigned count) {
        return vk::raii::ImageView(gpu.device, vk::ImageViewCreateInfo{.image = *storage->image, .viewType = vk::ImageViewType::e2D, .format = storage->format, .subresourceRange = {storage->aspect, first, count, 0, 1}});
    };
    storage->whole = view(0, mips);
    for (unsigned level = 0; level < mips; ++level) storage->mips.push_back(view(level, 1));
    gpu.submit([&](auto& commands) {
        const vk::ImageMemoryBarrier2 barrier{.dstStageMask = vk::PipelineStageFlagBits2::eAllCommands, .newLayout = vk::ImageLayout::eGeneral, .image = *storage->image, .subresourceRange = {storage->aspect, 0, mips, 0, 1}};
        commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
    });
    return image;
}

Pipeline& PassGraph::Impl::pipeline(const std::string& name, std::span<const Image> attachments, const Stencil& stencil) {
    const auto [cached, is_first_use] = shaders.try_emplace(name);
    if (is_first_use) cached->second = compile(name, camera_block + params->glsl(), shader_roots);
    const Shader& shader = cached->second;

    // Only the constants this shader uses take part in the key: a new value of another constant costs it no new pipeline.
    std::vector<uint32_t> constants;
    std::vector<vk::SpecializationMapEntry> entries;
    std::string key = name + char('0' + int(stencil.mode)) + std::to_string(stencil.value);
    uint32_t id = 0;
    for (const Parameter& p : *params) {
        if (p.use != Use::constant || !shader.interface.constants.contains(id++)) continue;
        entries.push_back({.constantID = id - 1, .offset = uint32_t(constants.size() * 4), .size = 4});
        constants.push_back(four_bytes(p));
        key += ' ' + std::to_string(constants.back());
    }
    for (const Image& image : attachments) key += ' ' + std::to_string(int(image.format));
    const auto [entry, is_new] = pipelines.try_emplace(key);
    Pipeline& p = entry->second;
    if (!is_new) return p;

    p.interface = shader.interface;
    const bool is_compute = shader.spirv.size() == 1;
    const vk::ShaderStageFlags stages = is_compute ? vk::ShaderStageFlagBits::eCompute : vk::ShaderStageFlagBits::eFragment;

    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const auto& [_, resource] : p.interface.resources) {
        using Kind = ShaderInterface::Kind;
        const auto type = resource.kind == Kind::sampler ? vk::DescriptorType::eCombinedImageSampler : resource.kind == Kind::image ? vk::DescriptorType::eStorageImage : vk::DescriptorType::eUniformBuffer;
        bindings.push_back({.binding = resource.binding, .descriptorType = type, .descriptorCount = 1, .stageFlags = stages});
    }
    p.set = {gpu.device, vk::DescriptorSetLayoutCreateInfo{.flags = vk::DescriptorSetLayoutCreateFlagBits::ePushDescriptorKHR, .bindingCount = uint32_t(bindings.size()), .pBindings = bindings.data()}};
    p.layout = {gpu.device, vk::PipelineLayoutCreateInfo{.setLayoutCount = 1, .pSetLayouts = &*p.set}};

    const vk::SpecializationInfo specialization{.mapEntryCount = uint32_t(entries.size()), .pMapEntries = entries.data(), .dataSize = constants.size() * 4, .pData = constants.data()};
    std::vector<vk::raii::ShaderModule> modules;
    std::vector<vk::PipelineShaderStageCreateInfo> stage_infos;
    for (const auto& spirv : shader.spirv) {
        modules.emplace_back(gpu.device, vk::ShaderModuleCreateInfo{.codeSize = spirv.size() * 4, .pCode = spirv.data()});
        const bool is_vertex = !is_compute && modules.size() == 1;
        stage_infos.push_back({.stage = is_compute ? vk::ShaderStageFlagBits::eCompute : is_vertex ? vk::ShaderStageFlagBits::eVertex : vk::ShaderStageFlagBits::eFragment,
                               .module = *modules.back(), .pName = "main", .pSpecializationInfo = is_vertex ? nullptr : &specialization});
    }
    if (is_compute) {
        p.pipeline = {gpu.device, nullptr, vk::ComputePipelineCreateInfo{.stage = stage_infos[0], .layout = *p.layout}};
        return p;
    }

    const vk::PipelineVertexInputStateCreateInfo no_vertices{};
    const vk::PipelineInputAssemblyStateCreateInfo triangles{.topology = vk::PrimitiveTopology::eTriangleList};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    const vk::PipelineRasterizationStateCreateInfo raster{.lineWidth = 1};
    const vk::PipelineMultisampleStateCreateInfo one_sample{.rasterizationSamples = vk::SampleCountFlagBits::e1};
    const bool writes = stencil.mode == Stencil::Mode::write;
    const vk::StencilOpState op{.passOp = writes ? vk::StencilOp::eReplace : vk::StencilOp::eKeep, .compareOp = writes ? vk::CompareOp::eAlways : vk::CompareOp::eEqual, .compareMask = 255, .writeMask = 255, .reference = stencil.value};
    const vk::PipelineDepthStencilStateCreateInfo depth_stencil{.stencilTestEnable = stencil.mode != Stencil::Mode::off, .front = op, .back = op};
    const std::vector<vk::PipelineColorBlendAttachmentState> no_blending(attachments.size(), {.colorWriteMask = vk::ColorComponentFlags(15)});
    const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = uint32_t(no_blending.size()), .pAttachments = no_blending.data()};
    const vk::DynamicState dynamic_states[] = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic{.dynamicStateCount = 2, .pDynamicStates = dynamic_states};
    std::vector<vk::Format> formats;
    for (const Image& image : attachments) formats.push_back(image.storage->format);
    const vk::Format stencil_format = stencil.mode == Stencil::Mode::off ? vk::Format::eUndefined : vk::Format::eD32SfloatS8Uint;
    const vk::PipelineRenderingCreateInfo rendering{.colorAttachmentCount = uint32_t(formats.size()), .pColorAttachmentFormats = formats.data(), .depthAttachmentFormat = stencil_format, .stencilAttachmentFormat = stencil_format};
    p.pipeline = {gpu.device, nullptr, vk::GraphicsPipelineCreateInfo{
        .pNext = &rendering, .stageCount = 2, .pStages = stage_infos.data(), .pVertexInputState = &no_vertices, .pInputAssemblyState = &triangles, .pViewportState = &viewport,
        .pRasterizationState = &raster, .pMultisampleState = &one_sample, .pDepthStencilState = &depth_stencil, .pColorBlendState = &blend, .pDynamicState = &dynamic, .layout = *p.layout}};
    return p;
}

void PassGraph::Impl::write_uniforms(const ShaderInterface& interface) {
    for (const Parameter& p : *params) {
        const auto offset = interface.offsets.find(p.name);
        if (p.use != Use::uniform || offset == interface.offsets.end()) continue;
        const uint32_t value = four_bytes(p);
        std::memcpy(uniforms.data + params_offset + offset->second, &value, sizeof value);
    }
}

void PassGraph::Impl::execute(Pass& pass) {
    std::vector<Image> attachments;
    if (!pass.is_compute_) attachments = pass.writes_;
    Pipeline& p = pipeline(pass.shader_, attachments, pass.stencil_);
    write_uniforms(p.interface);

    std::map<std::string, Pass::Read> offered;
    for (const auto& [name, image] : inputs) offered[name] = {image, false};
    for (const auto& read : pass.reads_) offered[read.image.name] = read;
    for (const auto& image : pass.writes_) offered[image.name] = {image, false};

    const auto view = [](const Image& i) { return i.mips == 1 ? *i.storage->mips[i.first_mip] : *i.storage->whole; };
    std::vector<vk::DescriptorImageInfo> image_infos;
    std::vector<vk::DescriptorBufferInfo> buffer_infos;
    std::vector<vk::WriteDescriptorSet> writes;
    image_infos.reserve(p.interface.resources.size());
    buffer_infos.reserve(p.interface.resources.size());
    for (const auto& [name, resource] : p.interface.resources) {
        vk::WriteDescriptorSet write{.dstBinding = resource.binding, .descriptorCount = 1};
        if (resource.kind == ShaderInterface::Kind::uniforms) {
            buffer_infos.push_back({.buffer = *uniforms.buffer, .offset = name == "Camera" ? camera_offset : params_offset, .range = 1024});
            write.descriptorType = vk::DescriptorType::eUniformBuffer;
            write.pBufferInfo = &buffer_infos.back();
        } else {
            const auto found = offered.find(name);
            if (found == offered.end()) {
                std::string names;
                for (const auto& [n, _] : offered) names += ' ' + n;
                fail(pass.shader_, " uses '", name, "', which the pass does not provide; it provides:", names);
            }
            const bool is_sampler = resource.kind == ShaderInterface::Kind::sampler;
            image_infos.push_back({.sampler = found->second.linear ? *linear : *nearest, .imageView = view(found->second.image), .imageLayout = vk::ImageLayout::eGeneral});
            write.descriptorType = is_sampler ? vk::DescriptorType::eCombinedImageSampler : vk::DescriptorType::eStorageImage;
            write.pImageInfo = &image_infos.back();
        }
        writes.push_back(write);
    }

    const glm::uvec2 area = pass.writes_.empty() ? extent : pass.writes_.front().extent;
    const auto record = [&](vk::raii::CommandBuffer& commands) {
        const vk::MemoryBarrier2 barrier{.srcStageMask = vk::PipelineStageFlagBits2::eAllCommands, .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
                                         .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands, .dstAccessMask = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite};
        commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
        const auto bind_point = pass.is_compute_ ? vk::PipelineBindPoint::eCompute : vk::PipelineBindPoint::eGraphics;
        commands.bindPipeline(bind_point, *p.pipeline);
        commands.pushDescriptorSetKHR(bind_point, *p.layout, 0, writes);
        if (pass.is_compute_) {
            const auto groups = [](unsigned n, unsigned size) { return (n + size - 1) / size; };
            commands.dispatch(groups(area.x, p.interface.local_size[0]), groups(area.y, p.interface.local_size[1]), 1);
            return;
        }
        std::vector<vk::RenderingAttachmentInfo> colours(attachments.size());
        for (const Image& image : attachments)
            colours[p.interface.outputs.at(image.name)] = {.imageView = view(image), .imageLayout = vk::ImageLayout::eGeneral, .loadOp = vk::AttachmentLoadOp::eLoad, .storeOp = vk::AttachmentStoreOp::eStore};
        const bool has_stencil = pass.stencil_.mode != Stencil::Mode::off;
        const vk::RenderingAttachmentInfo stencil{.imageView = has_stencil ? view(pass.stencil_.image) : vk::ImageView{}, .imageLayout = vk::ImageLayout::eGeneral, .loadOp = vk::AttachmentLoadOp::eLoad, .storeOp = vk::AttachmentStoreOp::eStore};
        commands.beginRendering({.renderArea = {{0, 0}, {area.x, area.y}}, .layerCount = 1, .colorAttachmentCount = uint32_t(colours.size()), .pColorAttachments = colours.data(),
                                 .pDepthAttachment = has_stencil ? &stencil : nullptr, .pStencilAttachment = has_stencil ? &stencil : nullptr});
        commands.setViewport(0, vk::Viewport{0, 0, float(area.x), float(area.y), 0, 1});
        commands.setScissor(0, vk::Rect2D{{0, 0}, {area.x, area.y}});
        commands.draw(3, 1, 0, 0);
        commands.endRendering();
    };
    // One submission per pass: lavapipe's timestamps do not wait for compute work, the CPU clock around a wait does.
    const auto start = std::chrono::steady_clock::now();
    gpu.submit(record);
    times.push_back({pass.shader_, std::chrono::steady_clock::now() - start});
}

PassGraph::PassGraph(Device& device, glm::uvec2 extent, std::vector<std::filesystem::path> shader_roots)
    : impl_(std::make_unique<Impl>(device, extent, std::move(shader_roots))) {}
PassGraph::~PassGraph() = default;

Image PassGraph::image(std::string name, Format format, unsigned mips, unsigned divisor) {
    if (const auto found = impl_->images.find(name); found != impl_->images.end()) return found->second;
    return impl_->images[name] = impl_->create(name, format, mips, divisor);
}

PassGraph::History PassGraph::history(std::string name, Format format) {
    const Image even = image(name + " (even)", format), odd = image(name + " (odd)", format);
    const bool swapped = impl_->history_parity[name] & 1;
    return {(swapped ? odd : even).as(name), (swapped ? even : odd).as("previous_" + name)};
}

PassGraph::Pass PassGraph::compute(std::string shader) { return {*impl_, std::move(shader), true}; }
PassGraph::Pass PassGraph::fragment(std::string shader) { return {*impl_, std::move(shader), false}; }

void PassGraph::begin_frame(const CameraData& camera, const ParameterSet& params, std::span<const Image> inputs) {
    std::memcpy(impl_->uniforms.data + camera_offset, &camera, sizeof camera);
    impl_->params = &params;
    impl_->inputs.clear();
    for (const Image& image : inputs) impl_->inputs[image.name] = image;
    impl_->times.clear();
    for (auto& [_, parity] : impl_->history_parity) ++parity;
}

const std::vector<PassTime>& PassGraph::times() const { return impl_->times; }
glm::uvec2 PassGraph::extent() const { return impl_->extent; }

void PassGraph::clear(const Image& image, glm::vec4 v) {
    const ImageStorage& s = *image.storage;
    impl_->gpu.submit([&](auto& commands) {
        const vk::ImageSubresourceRange range{s.aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1};
        if (image.format == Format::depth_stencil)
            commands.clearDepthStencilImage(*s.image, vk::ImageLayout::eGeneral, {v.x, uint32_t(v.y)}, range);
        else
            commands.clearColorImage(*s.image, vk::ImageLayout::eGeneral, vk::ClearColorValue{std::array{v.x, v.y, v.z, v.w}}, range);
    });
}

std::vector<float> PassGraph::download(const Image& image) {
    if (image.format != Format::rgba32f) fail("download of '", image.name, "': only rgba32f images can be downloaded");
    std::vector<float> pixels(size_t(image.extent.x) * image.extent.y * 4);
    HostBuffer buffer(impl_->gpu.device, pixels.size() * sizeof(float), vk::BufferUsageFlagBits::eTransferDst);
    impl_->gpu.submit([&](auto& commands) {
        commands.copyImageToBuffer(*image.storage->image, vk::ImageLayout::eGeneral, *buffer.buffer,
                                   vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, image.first_mip, 0, 1}, .imageExtent = {image.extent.x, image.extent.y, 1}});
    });
    std::memcpy(pixels.data(), buffer.data, pixels.size() * sizeof(float));
    return pixels;
}

PassGraph::Pass& PassGraph::Pass::read(const Image& image, bool linear) { reads_.push_back({image, linear}); return *this; }
PassGraph::Pass& PassGraph::Pass::write(const Image& image) { writes_.push_back(image); return *this; }
PassGraph::Pass& PassGraph::Pass::stencil(Stencil stencil) { stencil_ = std::move(stencil); return *this; }
void PassGraph::Pass::run() { graph_.execute(*this); }
