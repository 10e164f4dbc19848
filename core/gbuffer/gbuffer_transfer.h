#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/gbuffer_file.h"
#include "core/gpu/pass_graph.h"

/// Copies all images; `camera` and `depth_format` are those it was drawn with.
HostGBuffer download_gbuffer(PassGraph& graph, const GBuffer& gbuffer, const CameraData& camera,
                             DepthFormat depth_format);

/// Creates the images in `graph`, whose extent must be that of the G-buffer, and fills them, absent lit colour and
/// fallback with 0. The downloaded G-buffer has the same bits.
GBuffer upload_gbuffer(PassGraph& graph, const HostGBuffer& gbuffer);
