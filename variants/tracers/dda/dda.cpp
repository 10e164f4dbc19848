#include "variants/tracers/tracer.h"

namespace {

struct Dda final : Tracer {
    explicit Dda(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.depth_layers = layers.is("2")}; }

    // clang-format off
    Param<unsigned> stride{params, "dda.stride", 1, {1, 64},
        {"pixels", "distance of the tested pixels along the line; 1 visits each pixel of its major axis",
         "McGuire & Mara 2014, section 3"}};
    Param<float> stride_z_cutoff{params, "dda.stride_z_cutoff", 0.0f, {0.0f, 1e9f},
        {"m", "distance of a ray's origin from the camera plane from which its stride is 1; nearer ones are between 1 and "
         "`dda.stride` in proportion; 0: all strides are `dda.stride`", "kode80's port for Unity, where it is 100"}};
    Param<float> jitter{params, "dda.jitter", 1.0f, {0.0f, 2.0f},
        {"strides", "distance of the first tested pixel from the ray's own; below 1 a ray can meet its own surface",
         "McGuire & Mara 2014, section 3; the default is the advice in their later G3D version"}};
    Switch checkerboard{params, "dda.checkerboard", false,
        {"", "starts every other pixel's ray half a stride later, which turns bands into dither when the stride is above 1",
         "G3D Innovation Engine, by the authors"}};
    Switch interval_from_origin{params, "dda.interval_from_origin", false,
        {"", "as published, the first tested pixel counts the ray's depths from its origin on, so that mirrors which "
         "face the camera meet themselves", "McGuire & Mara 2014, listing in section 3"}};
    Param<float> thickness{params, "dda.thickness", 0.1f, {0.0f, 1e6f},
        {"m", "depth behind the visible surface that counts as solid; fits rooms, not small or large scenes",
         "McGuire & Mara 2014, section 3, leaves it to the scene; the default is that of Google's Filament"}};
    Param<float> relative_thickness{params, "dda.relative_thickness", 0.0f, {0.0f, 10.0f},
        {"of the depth", "added to thickness; grows with the distance from the camera and so fits scenes of any size",
         "ssrlab"}};
    Choice layers{params, "dda.layers", "1", {"1", "2"},
        {"", "layers of depth that are tested. 2: also the surface behind the visible one, which ends a ray as hidden: the "
         "screen does not show it", "McGuire & Mara 2014, section 3; they keep colours of all layers"}};
    Param<unsigned> max_steps{params, "dda.max_steps", 16384, {1, 16384},
        {"", "tested pixels before a ray is given up: it reaches dda.max_steps * dda.stride pixels",
         "McGuire & Mara 2014, section 3; the default crosses any screen"}};
    Param<float> max_distance{params, "dda.max_distance", 0.0f, {0.0f, 1e9f},
        {"m", "length of a ray; 0: twice the distance of the far plane",
         "McGuire & Mara 2014, section 3; the default leaves no ray short in scenes of any size"}};
    Switch clip_to_viewport{params, "dda.clip_to_viewport", true,
        {"", "ends the line half a pixel before it leaves the screen", "McGuire & Mara 2014, section 3"}};
    Switch refine{params, "dda.refine", false,
        {"", "when the stride is above 1, walks the last one again in single pixels, to the first that the ray is behind",
         "G3D Innovation Engine, by the authors"}};
    // clang-format on
};

}  // namespace

TracerEntry dda_tracer() {
    return {.name = "dda",
            .title = "Perspective-correct DDA",
            .source = "McGuire & Mara 2014, Efficient GPU Screen-Space Ray Tracing, JCGT 3(4)",
            .description =
                "Walks the ray's line on the screen pixel by pixel, or in strides, and passes behind what is "
                "thin.",
            .shader = "tracers/dda/dda.glsl",
            .create = [](ParameterSet& params) { return std::make_unique<Dda>(params); }};
}
