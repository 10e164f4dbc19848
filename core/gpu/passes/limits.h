#pragma once

class PassList;

/// An API that a technique is made for. The pass_list refuses what the API does not have.
///
/// webgl2: WebGL 2 with EXT_color_buffer_float, no more than every implementation must offer.
/// - Passes are fragment shaders over the whole image, valid as GLSL ES 3.00; push_constant blocks stand for uniforms.
///   No compute shaders, storage images or storage buffers, no meshes (their vertices lie in storage buffers).
/// - 4 colour targets, 16 textures. Formats: the table in format.cpp.
/// - No pass reads an image that it draws to. OpenGL ES 3.0 (section 4.4.3) allows it for mips that the texture's base
///   and maximum level exclude; drivers have failed there, so techniques copy.
/// - An image is read with all its mips: there are no views of some of them.
/// - Depth and stencil test use one image.
///
/// The size of images is not limited: the 2048 pixels that are guaranteed would rule out frames which most devices
/// draw. Sources: OpenGL ES 3.0.6; OpenGL ES Shading Language 3.00; WebGL 2.0 and its extension EXT_color_buffer_float
/// (Khronos).
enum class Limits { none, webgl2 };

/// "WebGL 2 with EXT_color_buffer_float"; "" for none.
const char* name_of(Limits limits);

/// Holds the passes, clears and uploads of a pass_list to the limits while it lives; what lies outside is an Error that
/// names pass, resource, and what is allowed.
class LimitScope {
public:
    LimitScope(PassList& pass_list, Limits limits);
    ~LimitScope();
    LimitScope(const LimitScope&) = delete;
    LimitScope& operator=(const LimitScope&) = delete;

private:
    PassList& pass_list_;
    const Limits before_;
};
