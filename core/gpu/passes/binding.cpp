#include "core/gpu/format.h"
#include "core/gpu/passes/pass_list_impl.h"
#include "core/gpu/resources.h"

#include <algorithm>

namespace {

vk::SamplerAddressMode address_mode(Wrap wrap) {
    using enum vk::SamplerAddressMode;
    constexpr vk::SamplerAddressMode modes[] = {eClampToEdge, eRepeat, eMirroredRepeat};  // in the order of Wrap
    return modes[size_t(wrap)];
}

/// All images have two dimensions. A shader that takes them for something else reads and writes beside them.
void check_type(const std::string& shader, const ShaderInterface::Resource& resource, const Image& image) {
    using Kind = ShaderInterface::Kind;
    if (resource.kind != Kind::sampler && resource.kind != Kind::image)
        fail(shader, " declares the block '", resource.name, "', and the pass has an image of this name");
    const bool is_integer = facts_of(image.format).coding == TexelCoding::uint_32;
    const std::string type =
        std::string(is_integer ? "u" : "") + (resource.kind == Kind::sampler ? "sampler2D" : "image2D");
    if (resource.type != type)
        fail(shader, " declares '", resource.name, "' as ", resource.type, ", and the image of the pass is a ", type);
}

}  // namespace

const vk::raii::Sampler& PassList::Impl::sampler(const Sampling& s) {
    const auto [entry, is_new] = samplers.try_emplace({int(s.is_linear), int(s.wrap_u), int(s.wrap_v)}, nullptr);
    const vk::Filter filter = s.is_linear ? vk::Filter::eLinear : vk::Filter::eNearest;
    if (is_new)
        entry->second = {gpu.device, vk::SamplerCreateInfo{.magFilter = filter,
                                                           .minFilter = filter,
                                                           .mipmapMode = s.is_linear ? vk::SamplerMipmapMode::eLinear
                                                                                     : vk::SamplerMipmapMode::eNearest,
                                                           .addressModeU = address_mode(s.wrap_u),
                                                           .addressModeV = address_mode(s.wrap_v),
                                                           .maxLod = VK_LOD_CLAMP_NONE}};
    return entry->second;
}

const Image* PassList::Impl::find_image(const Pass& pass, const Draw* draw, const std::string& name,
                                        Sampling& sampling) {
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

const Buffer* PassList::Impl::find_buffer(const Pass& pass, const Draw* draw, const std::string& name) {
    for (const std::vector<Buffer>* buffers : {draw ? &draw->buffers : nullptr, &pass.buffers_}) {
        if (!buffers) continue;
        for (const Buffer& buffer : *buffers)
            if (buffer.name == name) return &buffer;
    }
    return nullptr;
}

void PassList::Impl::fail_missing(const Pass& pass, const std::string& name) {
    std::vector<std::string> provided;
    for (const Read& read : pass.reads_) provided.push_back(read.image.name);
    for (const Image& image : pass.writes_) provided.push_back(image.name);
    for (const Buffer& buffer : pass.buffers_) provided.push_back(buffer.name);
    for (const auto& [input, _] : inputs) provided.push_back(input);
    std::ranges::sort(provided);
    fail(pass.shader_, " uses '", name, "', which the pass does not provide; it provides: ", joined(provided, " "));
}

/// Fails where a pass names something that its shader ignores, or reads something that is not written.
void PassList::Impl::check(const Pass& pass, const ShaderInterface& interface) {
    const auto is_used = [&](const std::string& name) {
        return interface.outputs.contains(name) ||
               std::ranges::any_of(interface.resources, [&](const auto& r) { return r.name == name; });
    };
    for (const Read& read : pass.reads_)
        if (!is_used(read.image.name))
            fail("pass ", pass.label_, " reads '", read.image.name, "', which ", pass.shader_, " does not use");
    for (const Image& image : pass.writes_)
        if (!is_used(image.name))
            fail("pass ", pass.label_, " writes '", image.name, "', which ", pass.shader_, " does not use");
    for (const Buffer& buffer : pass.buffers_)
        if (!is_used(buffer.name))
            fail("pass ", pass.label_, " uses buffer '", buffer.name, "', which ", pass.shader_, " does not use");
    for (const auto& push : pass.pushes_) {
        const auto bytes = interface.push_sizes.find(push.name);
        if (bytes == interface.push_sizes.end())
            fail("pass ", pass.label_, " sets '", push.name, "', which is no member of the push_constant block of ",
                 pass.shader_);
        if (bytes->second != push.size)
            fail("pass ", pass.label_, " sets '", push.name, "' of ", push.size, " bytes, and ", pass.shader_,
                 " declares ", bytes->second, " bytes");
    }
    for (const ShaderInterface::Resource& r : interface.resources)
        if (Sampling sampling; const Image* const image = find_image(pass, nullptr, r.name, sampling))
            check_type(pass.shader_, r, *image);
}

/// Not every device can do everything with every format. `what`: that it is asked to do, as in "filter it".
void PassList::Impl::require(const Image& image, vk::FormatFeatureFlagBits feature, const char* what) {
    if (!(image.storage->features & feature))
        fail_machine("image '", image.name, "' has the format ", vk::to_string(vulkan_format(image.format)),
                     ", and the Vulkan device '", gpu.info.name, "' cannot ", what);
}

void PassList::Impl::allow_uses(const Pass& pass, const ShaderInterface& interface, const std::vector<Image>& targets) {
    using Use = vk::ImageUsageFlagBits;
    using Feature = vk::FormatFeatureFlagBits;
    for (const Image& target : targets) {
        require(target, Feature::eColorAttachment, "draw to it");
        allow_use(gpu, target, Use::eColorAttachment);
    }
    for (const Image& image : {pass.depth_.image, pass.stencil_.image})
        if (image.storage) allow_use(gpu, image, Use::eDepthStencilAttachment);
    for (const auto& r : interface.resources) {
        if (r.kind != ShaderInterface::Kind::image) continue;
        Sampling sampling;  // draws have images of their own only to sample them
        const Image* image = find_image(pass, nullptr, r.name, sampling);
        if (!image) fail_missing(pass, r.name);
        require(*image, Feature::eStorageImage, "write it from shaders");
        allow_use(gpu, *image, Use::eStorage);
    }
}

void PassList::Impl::bind(const vk::raii::CommandBuffer& commands, const Pass& pass, const Draw* draw,
                          const Pipeline& pipeline) {
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
            if (!is_camera && r.name != "Params")
                fail(pass.shader_, " declares the uniform block '", r.name,
                     "'; use a push_constant block or a parameter");
            buffer_infos.push_back(
                {*uniforms.buffer, is_camera ? 0 : params_place(), is_camera ? params_offset : params_size});
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
            if (is_sampled && !image->storage->is_written)
                fail("pass ", pass.label_, " reads '", r.name, "', which nothing has written yet");
            if (is_sampled && sampling.is_linear)
                require(*image, vk::FormatFeatureFlagBits::eSampledImageFilterLinear, "filter it");
            const bool is_one_mip = !is_sampled || image->mips == 1;
            const vk::ImageView view = is_one_mip ? *image->storage->mips[image->first_mip] : *image->storage->whole;
            image_infos.push_back({is_sampled ? *sampler(sampling) : vk::Sampler{}, view, vk::ImageLayout::eGeneral});
            write.descriptorType =
                is_sampled ? vk::DescriptorType::eCombinedImageSampler : vk::DescriptorType::eStorageImage;
            write.pImageInfo = &image_infos.back();
        }
        writes.push_back(write);
    }
    const auto point = pipeline.is_compute ? vk::PipelineBindPoint::eCompute : vk::PipelineBindPoint::eGraphics;
    if (!writes.empty()) commands.pushDescriptorSetKHR(point, *pipeline.layout, 0, writes);
}
