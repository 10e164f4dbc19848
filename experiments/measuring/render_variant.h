#pragma once
#include "core/variant.h"

/// One frame of a variant with images of its own, measured or timed: the camera is that of the G-buffer, but for the
/// seed, so that histories go on from the frame before. A pass outside the variant's limits is an Error.
Reflections render_variant(PassGraph& graph, Variant& variant, CameraData camera, unsigned seed,
                           const GBuffer& gbuffer);
