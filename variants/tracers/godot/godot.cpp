#include "variants/tracers/tracer.h"

namespace {

struct Godot final : Tracer {
    explicit Godot(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.nearest_mips = pyramid_mips}; }

    // "Godot": godotengine/godot, servers/rendering/renderer_rd/shaders/effects/screen_space_reflection.glsl, commit
    // 45a0bc46 (4.6); values are those of scene/resources/environment.h.
    // clang-format off
    Param<unsigned> max_steps{params, "godot.max_steps", 16384, {1, 65536},
        {"cells", "looked at before a ray is given up", "Godot, max_steps: 64; the default crosses any screen"}};
    Switch reject_unfinished{params, "godot.reject_unfinished", true,
        {"", "a ray that is given up is a miss. As printed the place where it stands is judged as one that met "
         "something, and is a hit if godot.fade_off_surface leaves anything of it", "ssrlab"}};
    Param<unsigned> pyramid_mips{params, "godot.pyramid_mips", 7, {2, 13},
        {"mips", "levels of the depth pyramid, the full resolution included; as many as the image has, at most",
         "Godot: until a side has one texel, for which 13 stands. Its odd-sized levels have cells of three texels; "
         "ours are looked at on finer levels where they lack cells"}};
    Param<float> thickness{params, "godot.thickness", 0.0f, {0.0f, 1e6f},
        {"m", "depth behind a pixel's surface up to which a ray that enters the pixel meets it. Coarser cells have no "
         "thickness", "Godot, depth_tolerance: 0.5, which hangs curtains below things in rooms"}};
    Param<float> relative_thickness{params, "godot.relative_thickness", 0.01f, {0.0f, 10.0f},
        {"of the depth", "added to thickness; grows with the distance from the camera and so fits scenes of any size",
         "ssrlab; Godot: 0"}};
    Switch interval{params, "godot.interval", true,
        {"", "compares a pixel's solid depth with all depths that the ray has in it. As printed only that where it "
         "enters counts, and a ray that comes nearer falls through what it meets within the pixel, or meets it a pixel "
         "late",
         "ssrlab"}};
    Switch leave_own_plane{params, "godot.leave_own_plane", true,
        {"", "passes over what is less than half as high as the ray above the plane that it leaves: samples are "
         "steps, and at grazing angles the next one lies in the way. Its own pixel a ray leaves unlooked at in "
         "any case",
         "ssrlab; Godot has godot.normal_bias and godot.back_faces"}};
    Param<float> normal_bias{params, "godot.normal_bias", 0.0f, {0.0f, 1e6f},
        {"m", "length by which a ray begins above its surface, along the geometric normal, times 1 less the eighth "
         "power of the cosine between that normal and the shading one", "Godot: 1, whatever the scene's size, which "
         "moves what is near by up to a metre; 0: ssrlab"}};
    Switch bounce{params, "godot.bounce", false,
        {"", "a ray that would go into its surface is reflected by it, and ends where it was not sent", "Godot: on"}};
    Choice back_faces{params, "godot.back_faces", "reject", {"near", "reject"},
        {"", "which hits on the side that the camera does not see are misses. near: those nearer than two pixels on "
         "both axes; reject: all", "Godot: near, by the shading normal, where ours is the geometric one"}};
    Switch fade_off_surface{params, "godot.fade_off_surface", false,
        {"", "hits lose confidence with the distance between ray and surface where the ray ended: from all of it on "
         "the surface to none a thickness away, by the square of a smooth step", "Godot: on"}};
    Switch fade_at_border{params, "godot.fade_at_border", false,
        {"", "hits lose confidence with the product of their distances from the border on both axes, up to the square "
         "of a twentieth of width and height together",
         "Godot: on, and by where the previous frame saw the place, which a tracer does not know"}};
    Param<float> fade_in{params, "godot.fade_in", 0.0f, {0.0f, 16.0f},
        {"", "power of the length on the screen, in widths and heights, that confidence is multiplied by; 0: it is not",
         "Godot: 0.15, with which nothing is left where things touch"}};
    Param<float> fade_out{params, "godot.fade_out", 0.0f, {0.0f, 16.0f},
        {"", "the same of 1 less that length",
         "Godot: 2, with which no hit has a confidence above 0.58 together with godot.fade_in"}};
    // clang-format on
};

}  // namespace

TracerEntry godot_tracer() {
    return {.name = "godot",
            .title = "Godot's march through nearest depths",
            .source =
                "Godot Engine 4.6 (godotengine/godot, pull request 111210, servers/rendering/renderer_rd/shaders/"
                "effects/screen_space_reflection.glsl, commit 45a0bc46)",
            .description =
                "Goes a level coarser after each free cell and straight to the depth of what a cell shows nearest; "
                "passes pixel by pixel behind what is thin.",
            .shader = "tracers/godot/godot.glsl",
            .create = [](ParameterSet& params) { return std::make_unique<Godot>(params); }};
}
