#pragma once
#include "tests/variants/diligent_golden.h"

/// What the passes up to intersection leave of one frame.
struct DiligentTraced {
    HostImage radiance;   ///< rgb colour at the hit, w confidence
    HostImage direction;  ///< xyz world-space direction times length (m), w density (sr^-1)
};

/// Runs one frame. `parameters` override the defaults. `noise`: 128x128, two channels. `color`: what hits show;
/// without, the lit image.
DiligentTraced diligent_trace_frame(Device& device, const HostGBuffer& gbuffer, const nlohmann::json& parameters,
                                    const HostImage& noise, const HostImage* color = nullptr);
