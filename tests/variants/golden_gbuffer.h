#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "tests/variants/golden_vectors.h"

/// The recorded inputs of one frame as our G-buffer holds them: every surface is a metal, so that all reflect; what
/// came before is taken to be the same; the fallback is black. `uv_from_motion`: what the recorded motion is multiplied
/// with.
HostGBuffer golden_gbuffer(const LayeredImage& inputs, const CameraData& camera, glm::vec2 uv_from_motion);

/// Makes the lit colour of each pixel (u, v, 1) of its centre, and the fallback black, so that hits can be decoded.
void encode_hits(HostGBuffer& gbuffer);
