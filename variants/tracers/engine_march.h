#pragma once
#include "core/parameters.h"

/// Parameters that the marches `cells` and `fixed_stride` share: two modes of one engine's documentation of its
/// screen-space reflections, of 2026-01-14, which is "the document". What they do stands in the tracers' shaders.
struct EngineMarchParameters {
    /// `tracer`: what the parameters' names begin with.
    EngineMarchParameters(ParameterSet& params, const std::string& tracer)
        : max_distance(params, tracer + ".max_distance", 0.0f, {0.0f, 1e9f},
                       {"m", "length of a ray; 0: twice the distance of the far plane",
                        "the document: 50; the default leaves no ray short in scenes of any size"}),
          clip_to_near_plane(params, tracer + ".clip_to_near_plane", true,
                             {"",
                              "ends rays at the near plane. As printed their far end is projected even where it lies "
                              "behind the camera, and the line runs the opposite way",
                              "ssrlab"}),
          thickness(params, tracer + ".thickness", 0.1f, {0.0f, 1e6f},
                    {"m", "depth behind the visible surface that counts as solid",
                     "the document: 0.5, which hangs curtains below things in rooms; the default is dda's"}),
          relative_thickness(params, tracer + ".relative_thickness", 0.0f, {0.0f, 10.0f},
                             {"of the depth",
                              "added to thickness; grows with the distance from the camera and so fits scenes of any "
                              "size",
                              "ssrlab"}),
          sky_depth(params, tracer + ".sky_depth", 0.0f, {0.0f, 1.0f},
                    {"device depth",
                     "distance from the far plane's up to which nothing counts as drawn; 0: that plane's own only",
                     "the document: 1e-4, which with planes at 0.1 m and 100 m is all beyond 91 m"}),
          edge_fade(params, tracer + ".edge_fade", false,
                    {"", "hits lose confidence from `" + tracer + ".fade_start` to `" + tracer + ".fade_end`",
                     "the document: on"}),
          fade_start(params, tracer + ".fade_start", 0.8f, {0.0f, 1.0f},
                     {"of half the screen",
                      "distance from its middle from which hits fade out, on the axis where it is larger",
                      "the document; the linear fall is ssrlab's"}),
          fade_end(params, tracer + ".fade_end", 1.0f, {0.0f, 2.0f},
                   {"of half the screen", "distance from its middle at which nothing is left of them", "the document"}),
          distance_fade(
              params, tracer + ".distance_fade", false,
              {"", "hits lose confidence in proportion to the ray's length, all of it at `" + tracer + ".max_distance`",
               "the document: on; the linear fall is ssrlab's"}) {}

    Param<float> max_distance;
    Switch clip_to_near_plane;
    Param<float> thickness, relative_thickness, sky_depth;
    Switch edge_fade;
    Param<float> fade_start, fade_end;
    Switch distance_fade;
};
