#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/gbuffer_file.h"

#include <span>

/// What shaders may know of one image of the G-buffer. Normals are in world space, and radiance is linear.
struct GBufferImage {
    const char* name;  ///< in shaders
    Image GBuffer::*image;
    HostImage HostGBuffer::*pixels;
    Format exact, packed;      ///< GBufferFormats
    const char* meaning;       ///< of the channels: space, unit, range
    const char* background;    ///< the value where there is no surface
    bool is_optional = false;  ///< has no storage unless something needs it
};
/// All that techniques may read.
std::span<const GBufferImage> gbuffer_images();
