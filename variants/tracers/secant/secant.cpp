#include "variants/tracers/tracer.h"

namespace {

struct Secant final : Tracer {
    explicit Secant(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.random = random_start}; }

    // "Bevy": bevyengine/bevy, crates/bevy_pbr/src/ssr/raymarch.wesl, commit 4805ca79, and what ssr.wesl and mod.rs
    // beside it pass to it.
    // clang-format off
    Param<unsigned> linear_steps{params, "secant.linear_steps", 10, {2, 16384},
        {"steps", "into which a ray is divided between its start and where it leaves the screen or the camera's range "
         "of depths; no more than it crosses pixels, and two at least", "Bevy, linear_steps: 10"}};
    Param<float> exponent{params, "secant.exponent", 1.0f, {0.25f, 8.0f},
        {"", "power of the steps' places along the line; above 1 the first ones are shorter",
         "Bevy, linear_march_exponent: 1. It is a setting that Bevy does not pass on, so that it stays 1"}};
    Switch random_start{params, "secant.random_start", true,
        {"", "the first step has a random share of a step's length, which turns bands into noise; otherwise all are "
         "whole",
         "Bevy, jitter: a blue noise's third channel, where ours is the technique's random number"}};
    Switch search_last_step{params, "secant.search_last_step", true,
        {"", "looks at the line's end, too, after a first step that was shorter. As printed the last look is up to a "
         "step before it", "ssrlab"}};
    Param<unsigned> bisections{params, "secant.bisections", 5, {0, 24},
        {"", "times that the step is halved that ended behind something", "Bevy, bisection_steps: 5"}};
    Switch secant_step{params, "secant.secant_step", true,
        {"", "then goes to where the secant of the distances at both ends is 0, if that place is better",
         "Bevy, use_secant: on"}};
    Switch of_device_depth{params, "secant.of_device_depth", true,
        {"", "takes the secant of distances in device depth, in which rays and planes are straight, so that a flat "
         "surface is met exactly. As printed it is that of metres, which are not along a line on the screen",
         "ssrlab; Bevy: metres, over the near plane's"}};
    Switch keep_bisection{params, "secant.keep_bisection", true,
        {"", "takes the secant's place only if it lies within a thickness of what is seen there. As printed the ray is "
         "a miss otherwise, though its bisection has met something", "ssrlab"}};
    Param<float> thickness{params, "secant.thickness", 0.0f, {0.0f, 1e6f},
        {"m", "depth behind the visible surface that counts as solid",
         "Bevy, thickness: 0.25, which hangs curtains below things in rooms"}};
    Param<float> relative_thickness{params, "secant.relative_thickness", 0.01f, {0.0f, 10.0f},
        {"of the depth", "added to thickness; grows with the distance from the camera and so fits scenes of any size",
         "ssrlab; Bevy: 0"}};
    Switch both_surfaces{params, "secant.both_surfaces", true,
        {"", "a place is behind what is seen if it is behind the depth of its pixel and behind that between the four "
         "nearest pixels; otherwise its pixel's alone counts", "Bevy, use_sloppy_march: off"}};
    Switch split_apart{params, "secant.split_apart", true,
        {"", "takes a pixel's depth alone where the four nearest ones differ by more than a thickness. As printed the "
         "depth between them spans the gap, and rays pass beside edges through what they should meet", "ssrlab"}};
    Switch thickness_from_nearer{params, "secant.thickness_from_nearer", false,
        {"", "measures thickness from the nearer of both surfaces, which beside things that lie apart is one that is "
         "not there; otherwise from the pixel's", "Bevy: on"}};
    Choice behind{params, "secant.behind", "go_on", {"end", "skip", "go_on"},
        {"", "what becomes of a ray that is farther behind a surface than that is thick. end: it misses at the first "
         "surface that it comes behind, whatever lies beyond; skip: such places count as free, so that steps may pass "
         "through what is thin; go_on: each first place behind something is refined and judged, and the ray goes on if "
         "it is too thick there", "Bevy, march_behind_surfaces: end (off), skip (on); go_on: ssrlab"}};
    Switch clip_to_near_plane{params, "secant.clip_to_near_plane", true,
        {"", "ends rays at the near plane. As printed the end of a step of a metre gives the line's direction, and "
         "from behind the camera it is projected to the opposite side", "ssrlab"}};
    Switch leave_own_surface{params, "secant.leave_own_surface", true,
        {"", "passes over the pixel that a ray starts from, and over what is less than half as high as the ray above "
         "the plane that it leaves: samples are steps, and at grazing angles the next one lies in the way",
         "ssrlab; Bevy has both surfaces for that"}};
    Switch front_faces_only{params, "secant.front_faces_only", true,
        {"", "a ray that meets a surface from behind counts as a miss: the screen shows the other side of it",
         "ssrlab; Bevy does not ask"}};
    // clang-format on
};

}  // namespace

TracerEntry secant_tracer() {
    return {.name = "secant",
            .title = "A few steps, bisection and a secant",
            .source =
                "Bevy's screen-space reflections (bevyengine/bevy, pull request 22379, crates/bevy_pbr/src/ssr/"
                "raymarch.wesl, commit 4805ca79), after Stachowiak's raymarch.hlsl",
            .description =
                "Divides the ray's line on the screen into a few steps, halves the one that came behind the surface "
                "of its pixel and the one between pixels, and ends with one step of the secant method.",
            .shader = "tracers/secant/secant.glsl",
            .create = [](ParameterSet& params) { return std::make_unique<Secant>(params); }};
}
