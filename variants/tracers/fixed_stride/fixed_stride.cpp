#include "variants/tracers/engine_march.h"
#include "variants/tracers/tracer.h"

namespace {

struct FixedStride final : Tracer {
    explicit FixedStride(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.random = jitter > 0}; }

    EngineMarchParameters march{params, "fixed_stride"};  // "the document" is explained there

    // clang-format off
    Param<float> stride{params, "fixed_stride.stride", 1.0f, {0.125f, 64.0f},
        {"pixels", "length of a step on the screen",
         "the document: 2, 1.5, 1 and 0.5 at its qualities Low to Ultra"}};
    Param<float> stride_z_cutoff{params, "fixed_stride.stride_z_cutoff", 100.0f, {0.0f, 1e9f},
        {"m", "distance of a ray's origin from the camera plane from which its step is 1 pixel; nearer ones are "
         "between 1 and `fixed_stride.stride` in proportion; 0: all steps are `fixed_stride.stride`",
         "the document names 100, and no formula; the formula is that of kode80's port of McGuire & Mara 2014"}};
    Param<float> jitter{params, "fixed_stride.jitter", 0.0f, {0.0f, 1.0f},
        {"steps", "by how much the steps of a ray begin sooner at most, at random, which turns bands into noise when "
         "they are long", "the document, jitterOffset; what it shifts is ssrlab's"}};
    Param<unsigned> max_steps{params, "fixed_stride.max_steps", 16384, {1, 65536},
        {"steps", "before a ray is given up: it reaches fixed_stride.max_steps * fixed_stride.stride pixels. The "
         "document's qualities Low to Ultra reach 64, 72, 64 and 48",
         "the document: 32, 48, 64 and 96; the default crosses any screen"}};
    Switch refine{params, "fixed_stride.refine", true,
        {"", "halves the step on which a ray falls behind a surface, to find the place, at which thickness then counts. "
         "Otherwise hits are where steps end", "ssrlab; the document's march has no refinement"}};
    Param<unsigned> binary_search_steps{params, "fixed_stride.binary_search_steps", 8, {1, 16},
        {"", "times that `fixed_stride.refine` halves the step",
         "the document: 4 to 12, 8 by default, of which its march as printed makes no use"}};
    Choice step{params, "fixed_stride.step", "pixels", {"pixels", "uv"},
        {"", "of what the direction of steps is made. uv: of the ray's direction in texture coordinates, normalised, "
         "times the size of a texel, which on screens that are not square is another line",
         "uv: the document, as printed; pixels: ssrlab"}};
    Switch reject_towards_camera{params, "fixed_stride.reject_towards_camera", false,
        {"", "rays that come nearer to the camera plane miss, without a step. They do meet side walls and whatever "
         "leans", "the document, which takes them for rays that can hit nothing"}};
    Switch leave_own_surface{params, "fixed_stride.leave_own_surface", true,
        {"", "passes over the pixel that a ray starts from, and over what is less than half as high as the ray above "
         "the plane that it leaves: samples are steps, and at grazing angles the next one lies in the way",
         "ssrlab; the document has no rule"}};
    Switch front_faces_only{params, "fixed_stride.front_faces_only", true,
        {"", "a ray that meets a surface from behind counts as a miss: the screen shows the other side of it",
         "ssrlab"}};
    // clang-format on
};

}  // namespace

TracerEntry fixed_stride_tracer() {
    return {.name = "fixed_stride",
            .title = "Fixed stride on the screen",
            .source = "documentation of an engine's screen-space reflections (2026-01-14), mode SimpleLinear",
            .description =
                "Compares device depth, which is affine on the screen, at equal steps along the ray's line, and "
                "passes behind what is thin.",
            .shader = "tracers/fixed_stride/fixed_stride.glsl",
            .create = [](ParameterSet& params) { return std::make_unique<FixedStride>(params); }};
}
