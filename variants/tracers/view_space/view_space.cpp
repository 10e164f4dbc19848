#include "variants/tracers/tracer.h"

namespace {

struct ViewSpace final : Tracer {
    explicit ViewSpace(ParameterSet& params) : Tracer(params) {}

    // "Lettier": the tutorial 3D Game Shaders for Beginners, chapter Screen Space Reflection, whose code and text
    // differ.
    // clang-format off
    Param<float> max_distance{params, "view_space.max_distance", 40.0f, {0.0f, 1e9f},
        {"m", "length of a ray; the default fits rooms, not small or large scenes",
         "Lettier: 8 in the code, 15 in the text; the default crosses a hall"}};
    Param<float> relative_max_distance{params, "view_space.relative_max_distance", 0.0f, {0.0f, 1e6f},
        {"of the depth", "of the ray's origin; added to max_distance, and so fits scenes of any size", "ssrlab"}};
    Param<unsigned> steps{params, "view_space.steps", 512, {1, 65536},
        {"steps", "into which a ray is divided", "ssrlab; the slides name none, and Lettier steps on the screen"}};
    Param<float> thickness{params, "view_space.thickness", 0.1f, {0.0f, 1e6f},
        {"m", "depth behind the visible surface that counts as solid. If a step goes farther into depth, rays slip "
         "through", "Lettier: 0.5, which hangs curtains below things in rooms; the default is dda's"}};
    Param<float> relative_thickness{params, "view_space.relative_thickness", 0.0f, {0.0f, 10.0f},
        {"of the depth", "added to thickness; grows with the distance from the camera and so fits scenes of any "
         "size", "ssrlab"}};
    Param<unsigned> refinements{params, "view_space.refinements", 5, {0, 24},
        {"", "times that the step is halved that met something", "Lettier's code; 10 in the text"}};
    Switch return_best{params, "view_space.return_best", true,
        {"", "returns the nearest place at which the ray was within a surface's thickness. As printed it is the last "
         "one looked at, which may lie before it", "ssrlab; Lettier returns the last"}};
    Switch test_returned{params, "view_space.test_returned", true,
        {"", "where the last place is returned, only a hit at that place counts. As printed one hit while halving is "
         "enough", "ssrlab; Lettier does not test it"}};
    Switch clip_to_near_plane{params, "view_space.clip_to_near_plane", true,
        {"", "ends rays at the near plane. As printed their steps go on behind the camera, where they meet nothing",
         "ssrlab"}};
    Switch leave_own_surface{params, "view_space.leave_own_surface", true,
        {"", "passes over the pixel that a ray starts from, and over what is less than half as high as the ray above "
         "the plane that it leaves: samples are steps, and at grazing angles the next one lies in the way",
         "ssrlab; Lettier only makes a step first"}};
    Switch front_faces_only{params, "view_space.front_faces_only", true,
        {"", "a ray that meets a surface from behind counts as a miss: the screen shows the other side of it",
         "ssrlab"}};
    Switch visibility_fade{params, "view_space.visibility_fade", false,
        {"", "confidence falls with the cosine between the ray and the way back to the camera, with the depth behind "
         "the surface over its thickness, and with the ray's length over its largest", "Lettier: on"}};
    // clang-format on
};

}  // namespace

TracerEntry view_space_tracer() {
    return {.name = "view_space",
            .title = "Equal steps in view space",
            .source =
                "introduction of Stachowiak & Uludag 2015, Stochastic Screen-Space Reflections, as quoted by others; "
                "Lettier, 3D Game Shaders for Beginners",
            .description =
                "Projects points at equal distances along the ray, and halves the step that came behind a surface "
                "within its thickness.",
            .shader = "tracers/view_space/view_space.glsl",
            .create = [](ParameterSet& params) { return std::make_unique<ViewSpace>(params); }};
}
