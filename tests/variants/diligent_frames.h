#pragma once
#include "tests/variants/diligent_golden.h"
#include "tests/variants/diligent_passes.h"

/// Frames in a row on one graph, for tests that run passes one by one; images keep what older frames left in them.
struct DiligentFrames {
    PassGraph graph;
    DiligentParameters parameters;
    GBuffer gbuffer;

    DiligentFrames(Device& device, glm::uvec2 extent, const nlohmann::json& overrides) : graph(device, extent) {
        parameters.params.assign(overrides);
    }

    void begin(const HostGBuffer& host) {
        gbuffer = upload_gbuffer(graph, host);
        graph.begin_frame(host.camera, parameters.params, gbuffer.images());
    }

    DiligentMask mask() { return diligent_mask(graph, gbuffer, parameters.tracing, parameters.filter); }

    /// 1 for each pixel that DiligentMask::full or ::traced keeps.
    HostImage kept(const Image& mask) {
        const Image drawn = graph.image_of("drawn", Format::r8, mask.extent);
        graph.clear(drawn, {});
        auto pass = graph.fragment("constant_color.frag");
        pass.write(drawn.as("color")).set("value", glm::vec4(1.0f));
        draw_masked(pass, mask);
        return graph.download(drawn);
    }
};
