#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/gbuffer_file.h"
#include "core/gpu/passes/pass_list.h"

/// Copies all images to the CPU. `camera`, `depth_format`: those that the G-buffer was drawn with.
HostGBuffer download_gbuffer(PassList& pass_list, const GBuffer& gbuffer, const CameraData& camera,
                             DepthFormat depth_format);

/// GBuffer::dielectric_f0 of a scene in which it is 0.04 everywhere: one pixel.
Image one_dielectric_f0(PassList& pass_list);

/// Creates and fills the images in `pass_list`, whose extent must be that of the G-buffer. Absent lit colour and
/// fallback are 0. download_gbuffer() gives the same bits.
GBuffer upload_gbuffer(PassList& pass_list, const HostGBuffer& gbuffer);
