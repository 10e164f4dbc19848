#include "variants/tracers/tracer.h"

// Two tracers of one source, which share what counts as met.

namespace {

const char* const slides =
    "Stachowiak & Uludag 2015, Stochastic Screen-Space Reflections, SIGGRAPH course Advances in "
    "Real-Time Rendering, as quoted by others; gaps are filled by ssrlab";

struct Hierarchical final : Tracer {
    explicit Hierarchical(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.nearest_mips = pyramid_mips, .farthest_mips = pyramid_mips}; }

    // clang-format off
    Switch front_faces_only{params, "frostbite.front_faces_only", true,
        {"", "a ray that meets a surface from behind counts as a miss: the screen shows the other side of it",
         "ssrlab; AMD FidelityFX SSSR 1.5 rejects such hits, too"}};
    Switch leave_own_plane{params, "frostbite.leave_own_plane", true,
        {"", "a ray passes over what is less than half as high as itself above the plane that it leaves: samples are "
         "steps, and at grazing angles the next step of that plane lies in the way", "ssrlab"}};
    Param<float> relative_thickness{params, "frostbite.relative_thickness", 0.05f, {1e-6f, 10.0f},
        {"of the depth", "depth behind the visible surface that counts as solid", "ssrlab"}};
    Param<unsigned> max_hierarchical_steps{params, "frostbite.max_hierarchical_steps", 0, {0, 65536},
        {"cells", "of the depth pyramid that one ray may pass before it counts as a miss; 0: as many as it takes, which is "
         "at most the sum of the screen's width and height", "ssrlab"}};
    Param<unsigned> pyramid_mips{params, "frostbite.pyramid_mips", 7, {2, 13},
        {"mips", "levels of the depth pyramids, the full resolution included; as many as the image has, at most",
         "ssrlab; SSSR 1.5: 7"}};
    // clang-format on
};

struct Linear final : Tracer {
    explicit Linear(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.random = true}; }

    // clang-format off
    Param<unsigned> linear_steps{params, "frostbite.linear_steps", 32, {1, 4096},
        {"steps", "into which a ray is divided between its start and the border of the screen", "ssrlab"}};
    Param<unsigned> linear_refinements{params, "frostbite.linear_refinements", 8, {0, 16},
        {"", "times at most that the last linear step is halved, to find where on it the ray meets the surface; no more "
         "once it is a pixel or less", "ssrlab"}};
    // clang-format on
};

}  // namespace

TracerEntry frostbite_hierarchical_tracer() {
    return {.name = "frostbite_hierarchical",
            .title = "Frostbite's hierarchical march",
            .source = slides,
            .description =
                "Walks cells of pyramids of nearest and farthest depths, and passes behind what is thin: the "
                "result of looking at every pixel along the line.",
            .shader = "tracers/frostbite/hierarchical.glsl",
            .part = "frostbite",
            .create = [](ParameterSet& params) { return std::make_unique<Hierarchical>(params); }};
}

TracerEntry frostbite_linear_tracer() {
    return {.name = "frostbite_linear",
            .title = "Frostbite's march of rough surfaces",
            .source = slides,
            .description =
                "Equal steps on the screen from a random start, halved where they meet something. Parameters "
                "of what counts as met are those of frostbite_hierarchical.",
            .shader = "tracers/frostbite/linear.glsl",
            .part = "frostbite",
            .create = [](ParameterSet& params) { return std::make_unique<Linear>(params); }};
}
