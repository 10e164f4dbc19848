#include "tests/variants/golden_gbuffer.h"

HostGBuffer golden_gbuffer(const LayeredImage& inputs, const CameraData& camera, glm::vec2 uv_from_motion) {
    const HostImage &normal = golden_layer(inputs, "normal"), &color = golden_layer(inputs, "color");
    HostGBuffer gbuffer;
    gbuffer.camera = camera;
    gbuffer.depth = golden_layer(inputs, "depth");
    gbuffer.motion = golden_layer(inputs, "motion");
    const glm::uvec2 extent = gbuffer.extent();
    for (HostImage* image :
         {&gbuffer.geometric_normal, &gbuffer.normal, &gbuffer.base_color, &gbuffer.emission, &gbuffer.lit})
        *image = HostImage(extent, 4, 1.0f);
    gbuffer.fallback = HostImage(extent, 4);
    gbuffer.material_id = HostImage(extent, 1, 1.0f);
    for (size_t i = 0; i < color.pixel_count(); ++i) {
        gbuffer.normal.set_rgb(i, normal.rgb(i));
        gbuffer.geometric_normal.set_rgb(i, normal.rgb(i));
        gbuffer.normal.values[4 * i + 3] = golden_layer(inputs, "roughness").values[i];
        gbuffer.lit.set_rgb(i, color.rgb(i));
        gbuffer.motion.values[2 * i] *= uv_from_motion.x;
        gbuffer.motion.values[2 * i + 1] *= uv_from_motion.y;
    }
    gbuffer.previous_depth = gbuffer.depth;
    gbuffer.previous_normal = gbuffer.normal;
    return gbuffer;
}

void encode_hits(HostGBuffer& gbuffer) {
    const glm::uvec2 extent = gbuffer.extent();
    gbuffer.fallback = HostImage(extent, 4);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            gbuffer.lit.set_rgb(size_t(y) * extent.x + x,
                                {(float(x) + 0.5f) / float(extent.x), (float(y) + 0.5f) / float(extent.y), 1.0f});
}
