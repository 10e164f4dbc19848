#include "core/gpu/passes/pass_list_impl.h"
#include "core/gpu/resources.h"
#include "core/in_flight.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace {

std::string stage_of(const std::string& shader) { return shader.substr(0, shader.rfind('.')); }

vk::CullModeFlags cull_mode(Draw::Cull cull) {
    return cull == Draw::Cull::back    ? vk::CullModeFlagBits::eBack
           : cull == Draw::Cull::front ? vk::CullModeFlagBits::eFront
                                       : vk::CullModeFlagBits::eNone;
}

}  // namespace

PassList::Pass::Pass(PassList::Impl& pass_list, std::string shader, bool is_compute)
    : pass_list_(pass_list), shader_(std::move(shader)), label_(stage_of(shader_)), is_compute_(is_compute) {}

PassList::Pass PassList::compute(const std::string& shader) { return {*impl_, shader, true}; }
PassList::Pass PassList::fragment(const std::string& shader) { return {*impl_, shader, false}; }
PassList::Pass PassList::draw(const std::string& vertex_shader, const std::string& fragment_shader,
                              std::vector<Draw> draws) {
    Pass pass{*impl_, fragment_shader, false};
    pass.vertex_shader_ = vertex_shader;
    pass.draws_ = std::move(draws);
    return pass;
}

PassList::Pass& PassList::Pass::read(const Image& image, Sampling sampling) {
    return reads_.push_back({image, sampling}), *this;
}
PassList::Pass& PassList::Pass::write(const Image& image) { return writes_.push_back(image), *this; }
PassList::Pass& PassList::Pass::use(const Buffer& buffer) { return buffers_.push_back(buffer), *this; }
PassList::Pass& PassList::Pass::stencil(Stencil stencil) { return stencil_ = std::move(stencil), *this; }
PassList::Pass& PassList::Pass::depth(DepthTest test) { return depth_ = std::move(test), *this; }
PassList::Pass& PassList::Pass::include(const std::string& name, std::string glsl) {
    return includes_[name] = std::move(glsl), *this;
}
PassList::Pass& PassList::Pass::label(std::string stage) { return label_ = std::move(stage), *this; }
PassList::Pass& PassList::Pass::set(const std::string& name, float value) {
    return pushes_.push_back({name, {value}, 4}), *this;
}
PassList::Pass& PassList::Pass::set(const std::string& name, int value) {
    return pushes_.push_back({name, {std::bit_cast<float>(value)}, 4}), *this;
}
PassList::Pass& PassList::Pass::set(const std::string& name, unsigned value) {
    return pushes_.push_back({name, {std::bit_cast<float>(value)}, 4}), *this;
}
PassList::Pass& PassList::Pass::set(const std::string& name, glm::vec4 value) {
    return pushes_.push_back({name, {value.x, value.y, value.z, value.w}, 16}), *this;
}

void PassList::Pass::run() {
    if (!is_compute_) return pass_list_.run(*this, {}, nullptr, 0);
    if (writes_.empty()) fail("pass ", label_, " writes no image, so run() needs an extent");
    run(writes_.front().extent);
}

void PassList::Pass::run(glm::uvec2 extent) {
    const InFlightText at_work(in_flight().pass, label_);
    const Shader& shader = pass_list_.pipelines.shader(shader_, vertex_shader_, *pass_list_.params, includes_,
                                                       pass_list_.changes_of(*this));
    const auto local = shader.interface.local_size;
    dispatch_groups({(extent.x + local[0] - 1) / local[0], (extent.y + local[1] - 1) / local[1], 1});
}

void PassList::Pass::dispatch_groups(glm::uvec3 groups) { pass_list_.run(*this, groups, nullptr, 0); }
void PassList::Pass::dispatch(const Buffer& arguments, size_t offset) { pass_list_.run(*this, {}, &arguments, offset); }

glm::uvec2 PassList::Impl::area_of(const Pass& pass, const std::vector<Image>& attachments) {
    return !attachments.empty()        ? attachments.front().extent
           : pass.depth_.image.storage ? pass.depth_.image.extent
                                       : pass.stencil_.image.extent;
}

void PassList::Impl::draw(const vk::raii::CommandBuffer& commands, const Pass& pass, const Pipeline& pipeline,
                          const std::vector<Image>& attachments) {
    const bool has_depth = bool(pass.depth_.image.storage), has_stencil = pass.stencil_.mode != Stencil::Mode::off;
    const glm::uvec2 area = area_of(pass, attachments);
    const auto attachment = [](vk::ImageView view) {
        return vk::RenderingAttachmentInfo{.imageView = view,
                                           .imageLayout = vk::ImageLayout::eGeneral,
                                           .loadOp = vk::AttachmentLoadOp::eLoad,
                                           .storeOp = vk::AttachmentStoreOp::eStore};
    };
    std::vector<vk::RenderingAttachmentInfo> colors;
    for (const Image& image : attachments) {
        if (image.extent != area)
            fail("pass ", pass.label_, " writes '", image.name, "' of another size than '", attachments.front().name,
                 "'");
        colors.push_back(attachment(*image.storage->mips[image.first_mip]));
    }
    const vk::RenderingAttachmentInfo depth = has_depth     ? attachment(*pass.depth_.image.storage->attachment)
                                              : has_stencil ? attachment(*pass.stencil_.image.storage->attachment)
                                                            : vk::RenderingAttachmentInfo{};
    const bool has_depth_attachment = has_depth || has_stencil;
    commands.beginRendering({.renderArea = {{}, {area.x, area.y}},
                             .layerCount = 1,
                             .colorAttachmentCount = uint32_t(colors.size()),
                             .pColorAttachments = colors.data(),
                             .pDepthAttachment = has_depth_attachment ? &depth : nullptr,
                             .pStencilAttachment = has_stencil ? &depth : nullptr});
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

std::vector<std::byte> PassList::Impl::push_block(const Pass& pass, const ShaderInterface& interface) {
    std::vector<std::byte> block(interface.push_size);
    for (const auto& push : pass.pushes_)
        std::memcpy(block.data() + interface.push_offsets.at(push.name), push.bits.data(), push.size);
    return block;
}

/// Says only what differs from the shader as it is, which is not made a second time then.
ShaderChanges PassList::Impl::changes_of(const Pass& pass) const {
    ShaderChanges result;
    if (changes.glsl_of)
        if (std::optional<GlslChange> change = changes.glsl_of(pass.label_)) result.glsl.push_back(*std::move(change));
    if (!changes.format_of) return result;
    const ShaderInterface& as_it_is =
        pipelines.shader(pass.shader_, pass.vertex_shader_, *params, pass.includes_).interface;
    for (const Image& image : pass.writes_)
        if (as_it_is.formatted_images.contains(image.name)) result.image_formats[image.name] = image.format;
    return result;
}

void PassList::Impl::run(Pass& pass, std::optional<glm::uvec3> groups, const Buffer* arguments,
                         size_t arguments_offset) {
    const InFlightText at_work(in_flight().pass, pass.label_);
    const ShaderChanges changed = changes_of(pass);
    const Shader& shader = pipelines.shader(pass.shader_, pass.vertex_shader_, *params, pass.includes_, changed);
    check(pass, shader.interface);
    PipelineState state{
        .attachments = {}, .stencil = pass.stencil_.mode, .stencil_value = pass.stencil_.value, .depth = {}};
    if (pass.depth_.image.storage)
        state.depth = {pass.depth_.compare, pass.depth_.is_written, pass.depth_.image.format};
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
    check_limits(pass, shader, attachments);
    allow_uses(pass, shader.interface, attachments);
    const auto record = [&](const vk::raii::CommandBuffer& commands, const Pipeline& pipeline) {
        commands.bindPipeline(pass.is_compute_ ? vk::PipelineBindPoint::eCompute : vk::PipelineBindPoint::eGraphics,
                              *pipeline.pipeline);
        if (pipeline.interface.push_size) {
            const std::vector<std::byte> block = push_block(pass, pipeline.interface);
            const vk::ShaderStageFlags stages =
                pass.is_compute_ ? vk::ShaderStageFlagBits::eCompute
                                 : vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
            commands.pushConstants<std::byte>(*pipeline.layout, stages, 0, block);
        }
        if (!pass.is_compute_) return draw(commands, pass, pipeline, attachments);
        bind(commands, pass, nullptr, pipeline);
        if (arguments)
            commands.dispatchIndirect(*arguments->storage->buffer.buffer, arguments_offset);
        else
            commands.dispatch(groups->x, groups->y, groups->z);
    };
    const auto workgroups = [&] {
        if (!arguments) return groups.value_or(glm::uvec3(0));
        flush();
        const std::vector<std::byte> bytes = download_bytes(gpu, *arguments);
        glm::uvec3 result;
        std::memcpy(&result, bytes.data() + arguments_offset, sizeof result);
        return result;
    };
    if (!watcher || !run_watched(pass, changed, state, attachments, workgroups, record)) {
        const Pipeline& pipeline =
            pipelines.pipeline(pass.shader_, pass.vertex_shader_, *params, pass.includes_, constants, state, changed);
        execute(pass.label_, [&](const vk::raii::CommandBuffer& commands) { record(commands, pipeline); });
    }
    for (const Image& image : pass.writes_) image.storage->is_written = true;
    for (const Image* image : {&pass.depth_.image, &pass.stencil_.image})
        if (image->storage) image->storage->is_written = true;
    if (observer) observer(pass.label_, pass.writes_);
}
