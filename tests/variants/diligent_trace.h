#pragma once
#include "tests/variants/diligent_golden.h"
#include "tests/variants/mirror_scenes.h"
#include "tests/variants/technique_fixture.h"

/// What the passes up to intersection leave of one frame.
struct DiligentTraced {
    HostImage radiance;   ///< rgb colour at the hit, w confidence
    HostImage direction;  ///< xyz world-space direction times length (m), w density (sr^-1)
};

/// Runs one frame. `parameters` override the defaults. `noise`: 128x128, two channels. `color`: what hits show;
/// without, the lit image.
DiligentTraced diligent_trace_frame(Device& device, const HostGBuffer& gbuffer, const nlohmann::json& parameters,
                                    const HostImage& noise, const HostImage* color = nullptr);

/// Frames of a synthetic scene. Unless asked otherwise rays are kept in 32 bits, so that they can be measured.
struct DiligentTracing : TechniqueTest {
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = {96, 120}};
    HostImage noise{{128, 128}, 2, 0.5f};

    CameraData camera() const { return camera_data(pose, nullptr, view); }
    HostGBuffer gbuffer_of(const SyntheticScene& scene) { return host_gbuffer(device(), pose, view, scene); }

    DiligentTraced trace(const HostGBuffer& gbuffer, nlohmann::json parameters = nlohmann::json::object(),
                         const HostImage* color = nullptr) {
        if (!parameters.contains("float_rays")) parameters["float_rays"] = true;
        return diligent_trace_frame(device(), gbuffer, parameters, noise, color);
    }
};

/// Sum of the confidences.
double confidence_of(const DiligentTraced& traced);
