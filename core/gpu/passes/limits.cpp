#include "core/gpu/passes/limits.h"

#include "core/gpu/format.h"
#include "core/gpu/passes/pass_list_impl.h"

namespace {

// Least values that every implementation supports: OpenGL ES 3.0.6, tables of implementation-dependent values in
// section 6.2.
constexpr size_t max_draw_buffers = 4, max_texture_image_units = 16, max_uniform_block_size = 16384;
static_assert(std::max(params_offset, params_size) <= max_uniform_block_size);

std::string formats_that(bool FormatFacts::*can) {
    std::string names;
    for (const FormatFacts& format : all_formats())
        if (format.*can) names += (names.empty() ? "" : ", ") + std::string(format.opengl_name);
    return names;
}

/// `fact`: what WebGL 2 does in its place.
template <class... Parts>
[[noreturn]] void refuse(const std::string& pass, const std::string& fact, const Parts&... parts) {
    fail("pass ", pass, " ", parts..., ", outside the limits of WebGL 2, which ", fact);
}

void check_targets(const std::string& pass, const std::vector<Image>& targets) {
    if (targets.size() > max_draw_buffers)
        refuse(pass, "guarantees " + std::to_string(max_draw_buffers), "draws to ", targets.size(),
               " colour targets, the last of them '", targets.back().name, "'");
    for (const Image& target : targets)
        if (const FormatFacts& format = facts_of(target.format); !format.is_color_renderable)
            refuse(pass, "with EXT_color_buffer_float has " + formats_that(&FormatFacts::is_color_renderable),
                   "has the colour target '", target.name, "' of format ", format.opengl_name);
}

/// Adds the images of the tests, which count as drawn to even where they are not written.
void add_tested(const std::string& pass, const DepthTest& depth, const Stencil& stencil, std::vector<Image>& drawn) {
    if (depth.image.storage && stencil.image.storage && depth.image.storage != stencil.image.storage)
        refuse(pass, "keeps both in one image", "tests depth in '", depth.image.name, "' and stencil in '",
               stencil.image.name, "'");
    for (const Image* image : {&depth.image, &stencil.image})
        if (image->storage) drawn.push_back(*image);
}

void check_texture(const std::string& pass, const Image& texture, const Sampling& sampling,
                   const std::vector<Image>& drawn) {
    for (const Image& image : drawn)
        if (image.storage == texture.storage)
            refuse(pass, "reads no image while it is drawn to", "reads '", texture.name, "' and draws to it as '",
                   image.name, "'");
    const unsigned mips = texture.storage->info.mipLevels;
    if (texture.mips != mips)
        refuse(pass, "has no views of textures and reads all mips", "reads ", texture.mips, " of the ", mips,
               " mips of '", texture.name, "'");
    if (const FormatFacts& format = facts_of(texture.format); sampling.is_linear && !format.is_filterable)
        refuse(pass, "filters " + formats_that(&FormatFacts::is_filterable), "filters '", texture.name, "' of format ",
               format.opengl_name, " linearly");
}

}  // namespace

const char* name_of(Limits limits) { return limits == Limits::none ? "" : "WebGL 2 with EXT_color_buffer_float"; }

LimitScope::LimitScope(PassList& pass_list, Limits limits) : pass_list_(pass_list), before_(pass_list.impl_->limits) {
    pass_list_.impl_->limits = limits;
}
LimitScope::~LimitScope() { pass_list_.impl_->limits = before_; }

void PassList::Impl::check_limits(const Pass& pass, const Shader& shader, const std::vector<Image>& targets) {
    if (limits == Limits::none) return;
    if (pass.is_compute_) refuse(pass.label_, "has vertex and fragment shaders only", "is a compute shader");
    if (!pass.vertex_shader_.empty())
        refuse(pass.label_, "has no such buffers", "draws meshes, whose vertices lie in storage buffers");
    check_targets(pass.label_, targets);
    std::vector<Image> drawn = targets;
    add_tested(pass.label_, pass.depth_, pass.stencil_, drawn);
    check_resources(pass, shader.interface, drawn);
    try {
        pipelines.require_webgl2(shader, pass.shader_, *params, pass.includes_);
    } catch (const Error& error) {
        refuse(pass.label_, std::string("takes GLSL ES 3.00: ") + error.what(), "has a shader of another language");
    }
}

void PassList::Impl::check_resources(const Pass& pass, const ShaderInterface& interface,
                                     const std::vector<Image>& drawn) {
    using Kind = ShaderInterface::Kind;
    size_t textures = 0;
    for (const ShaderInterface::Resource& r : interface.resources) {
        if (r.kind == Kind::storage)
            refuse(pass.label_, "has no such buffers", "uses the storage buffer '", r.name, "'");
        if (r.kind == Kind::image)
            refuse(pass.label_, "writes to colour targets only", "uses the storage image '", r.name, "'");
        if (r.kind != Kind::sampler) continue;
        Sampling sampling;
        const Image* texture = find_image(pass, nullptr, r.name, sampling);
        if (!texture) fail_missing(pass, r.name);
        check_texture(pass.label_, *texture, sampling, drawn);
        ++textures;
    }
    if (textures > max_texture_image_units)
        refuse(pass.label_, "guarantees " + std::to_string(max_texture_image_units), "reads ", textures, " textures");
}

void PassList::Impl::check_limits(const Buffer& buffer) {
    if (limits == Limits::webgl2)
        fail("the storage buffer '", buffer.name, "' lies outside the limits of WebGL 2, which has no such buffers");
}

/// The texels of depth with stencil, FLOAT_32_UNSIGNED_INT_24_8_REV, are a type for which WebGL 2 takes no data.
void PassList::Impl::check_upload_limits(const Image& image) {
    if (limits == Limits::webgl2 && image.format == Format::d32f_s8)
        fail("the upload to '", image.name,
             "' of format DEPTH32F_STENCIL8 lies outside the limits of WebGL 2, which only draws and clears such "
             "images");
}
