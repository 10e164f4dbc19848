#pragma once
#include "core/parameters.h"

/// Parameters of the mips that cones choose. "Godot" is Godot 4.6 (MIT licence, Copyright (c) 2014-present Godot
/// Engine contributors), servers/rendering/renderer_rd/shaders/effects: "trace" is screen_space_reflection.glsl at
/// commit 45a0bc46 with the formula for levels of pull request 115904, "filter" screen_space_reflection_filter.glsl at
/// 42303b2a, "resolve" screen_space_reflection_resolve.glsl at db8de87d, "composite" the forward clustered shader.
/// Switches under "corrections" fix one defect each.
struct ConeMipsParameters {
    ParameterSet& params;

    // clang-format off
    // Which level of the mips a pixel shows.
    Param<float> level_radius{params, "level_radius", 16.0f, {1.0f, 1000.0f},
        {"traced pixels", "radius r of the sphere that fits into the end of the cone for which level 1 is shown; in "
         "general it is level log2(1 + radius / r)", "Godot, trace"}};
    Param<float> far_end{params, "far_end", 1.25f, {0.01f, 10.0f},
        {"of the screen", "length of a ray on the screen from which on nothing is blurred", "Godot, trace"}};
    Param<float> far_power{params, "far_power", 0.2f, {0.0f, 10.0f},
        {"", "power of what is left up to far_end, at most 1, by which levels are multiplied; 0: by 1",
         "Godot, trace"}};
    Param<float> mirror_roughness{params, "mirror_roughness", 0.001f, {0.0f, 1.0f},
        {"perceptual", "surfaces as smooth as this are not blurred", "Godot, trace"}};

    // The mips.
    Param<float> miss_weight{params, "miss_weight", 0.2f, {0.0f, 1.0f},
        {"", "weight, times the level, at most 1, of neighbours of whose rays nothing is known; where all is known it "
         "is 1", "Godot, filter"}};

    // What is shown.
    Param<float> fade_begin{params, "fade_begin", 0.6f, {0.0f, 1.0f},
        {"perceptual", "roughness from which on reflections fade to the fallback", "Godot, composite"}};
    Param<float> fade_width{params, "fade_width", 0.1f, {0.001f, 1.0f},
        {"perceptual", "over which they do", "Godot, composite; its rays end where it does, max_roughness = 0.7"}};
    Param<float> depth_phi{params, "depth_phi", 2048.0f, {0.0f, 1e6f},
        {"1 / device depth", "with half_resolution: how fast the weight of a traced pixel falls with the difference in "
         "depth", "Godot, resolve"}};
    Param<float> normal_phi{params, "normal_phi", 32.0f, {0.0f, 1e4f},
        {"", "how fast with 1 minus the cosine between the normals", "Godot, resolve"}};
    Param<float> roughness_phi{params, "roughness_phi", 16.0f, {0.0f, 1e4f},
        {"1 / perceptual roughness", "how fast with the difference in roughness", "Godot, resolve"}};

    // Corrections.
    Switch square_lengths{params, "square_lengths", false,
        {"", "lengths on the screen are shares of its longer side. The original adds shares of width and height, so "
         "that at 16:9 rays up and down the screen have cones 1.8 times too wide", "ssrlab"}};
    Switch lobe_cone{params, "lobe_cone", false,
        {"", "the level is that whose Gaussian holds half of its energy where the GGX lobe does, at the ray's length "
         "in the mirror image, however far. The original's cone opens in proportion to perceptual roughness, and its "
         "levels' standard deviation is 0.12 of its radius", "ssrlab"}};
    Switch even_weights{params, "even_weights", false,
        {"", "neighbours weigh alike, so that confidence is a mean. By miss_weight reflections grow by up to 10 traced "
         "pixels into misses", "ssrlab"}};
    Switch tone_map_colors{params, "tone_map_colors", false,
        {"", "colours are tone mapped, and weighed by confidence then. The original maps their product, and borders of "
         "bright reflections turn dark", "ssrlab"}};
    Switch average_linear{params, "average_linear", false,
        {"", "colours are averaged without a tone map, which takes more energy from highlights the brighter they are",
         "ssrlab"}};
    Switch exact_upsampling{params, "exact_upsampling", false,
        {"", "with half_resolution: the first row and column lie where they are, sizes may be odd, and weights are "
         "relative to the best of the four. The original moves that row and column by half a traced pixel, and is "
         "black where all four vanish", "ssrlab"}};
    // clang-format on
};
