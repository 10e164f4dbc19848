#pragma once
#include "core/variant.h"

/// Mirror rays walked pixel by pixel along their line on the screen: McGuire & Mara 2014, "Efficient GPU Screen-Space
/// Ray Tracing", Journal of Computer Graphics Techniques 3(4), for one layer of depth. The image `hit` of the graph
/// (rgba32f) keeps where each ray ended: uv on the un-jittered screen, distance (m), 1 if it met anything.
class McGuireDda final : public Variant {
public:
    Reflections render(PassGraph& graph, const GBuffer& gbuffer) override;
    std::vector<LeftOut> leave_out(const SceneFacts& facts) override;
    bool depends_on_seed() const override { return false; }

private:
    bool is_left_out_ = false;

    // clang-format off
    Param<unsigned> stride{params, "stride", 1, {1, 64},
        {"pixels", "distance of the tested pixels along the line; 1 visits each pixel of its major axis",
         "McGuire & Mara 2014, section 3"}};
    Param<float> jitter{params, "jitter", 1.0f, {0.0f, 2.0f},
        {"strides", "distance of the first tested pixel from the ray's own; below 1 a ray can meet its own surface",
         "McGuire & Mara 2014, section 3; the default is the advice in their later G3D version"}};
    Switch checkerboard{params, "checkerboard", false,
        {"", "starts every other pixel's ray half a stride later, which turns bands into dither when stride > 1",
         "G3D Innovation Engine, by the authors"}};
    Switch interval_from_origin{params, "interval_from_origin", false,
        {"", "as published, the first tested pixel counts the ray's depths from its origin on, so that mirrors which "
         "face the camera meet themselves", "McGuire & Mara 2014, listing in section 3"}};
    Param<float> thickness{params, "thickness", 0.1f, {0.0f, 1e6f},
        {"m", "depth behind the visible surface that counts as solid; fits rooms, not small or large scenes",
         "McGuire & Mara 2014, section 3, leaves it to the scene; the default is that of Google's Filament"}};
    Param<float> relative_thickness{params, "relative_thickness", 0.0f, {0.0f, 1.0f},
        {"of the depth", "added to thickness; grows with the distance from the camera and so fits scenes of any size",
         "ssrlab"}};
    Param<unsigned> max_steps{params, "max_steps", 16384, {1, 16384},
        {"", "tested pixels before a ray is given up: it reaches max_steps * stride pixels",
         "McGuire & Mara 2014, section 3; the default crosses any screen"}};
    Param<float> max_distance{params, "max_distance", 0.0f, {0.0f, 1e9f},
        {"m", "length of a ray; 0: twice the distance of the far plane",
         "McGuire & Mara 2014, section 3; the default leaves no ray short in scenes of any size"}};
    Switch clip_to_viewport{params, "clip_to_viewport", true,
        {"", "ends the line half a pixel before it leaves the screen", "McGuire & Mara 2014, section 3"}};
    Switch refine{params, "refine", false,
        {"", "when stride > 1, walks the last stride again in single pixels, to the first that the ray is behind",
         "G3D Innovation Engine, by the authors"}};
    Switch bilinear_color{params, "bilinear_color", false,
        {"", "filters the colour at the hit bilinearly; otherwise it is that of the tested pixel", "ssrlab"}};
    Param<float> max_roughness{params, "max_roughness", 0.6f, {0.0f, 1.0f},
        {"perceptual", "rougher surfaces are left to the fallback", "ssrlab; the paper traces mirrors only"}};
    Switch trace_inward_rays{params, "trace_inward_rays", true,
        {"", "also traces mirror rays that shading normals turn below the geometric surface",
         "McGuire & Mara 2014 do not tell them apart"}};
    // clang-format on
};
