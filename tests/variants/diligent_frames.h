#pragma once
#include "tests/variants/diligent_golden.h"
#include "tests/variants/diligent_passes.h"

/// Frames in a row on one pass_list, for tests that run passes one by one; images keep what older frames left in them.
struct DiligentFrames {
    PassList pass_list;
    DiligentParameters parameters;
    GBuffer gbuffer;

    DiligentFrames(Device& device, glm::uvec2 extent, const nlohmann::json& overrides) : pass_list(device, extent) {
        parameters.params.assign(overrides);
    }

    void begin(const HostGBuffer& host) {
        gbuffer = upload_gbuffer(pass_list, host);
        pass_list.begin_frame(host.camera, parameters.params, gbuffer.images());
    }

    DiligentMask mask() { return diligent_mask(pass_list, gbuffer, parameters.tracing, parameters.filter); }

    /// 1 for each pixel that DiligentMask::full or ::traced keeps.
    HostImage kept(const Image& mask) {
        const Image drawn = pass_list.image_of("drawn", Format::r8, mask.extent);
        pass_list.clear(drawn, {});
        auto pass = pass_list.fragment("constant_color.frag");
        pass.write(drawn.as("color")).set("value", glm::vec4(1.0f));
        draw_masked(pass, mask);
        return pass_list.download(drawn);
    }
};
