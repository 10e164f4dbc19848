#pragma once
#include "core/gpu/passes/pass_list.h"

struct GBuffer;

/// A guess at what surrounds the camera, from what the screen shows and showed: for rays that leave it, and for
/// surfaces so rough that a ray is not worth its time. Engines ask reflection probes for that, which somebody has
/// placed. Read by shaders that include common/screen_probe/lookup.glsl.
///
/// Both images are maps of the directions in world space, of screen_probe_width squared texels within a border of one.
/// A direction that the screen never showed is guessed from those that it did, near ones and those of the same
/// elevation first: floors lie below, the sky above, and walls around. Of emission nothing is spread, since a lamp on
/// the screen does not make another one beside it likely.
struct ScreenProbe {
    Image surfaces;  ///< `screen_probe`, rgba32f: a share of the directions that meet a surface; rgb that times its
                     ///< diffusely reflected radiance
    Image nearness;  ///< `screen_probe_nearness`, r32f: 1 / distance of these surfaces from the camera (1/m)
};

/// Adds two passes, the stages of screen_probe_stages(). Directions that leave the screen keep what they were until
/// they are seen again; where the camera has no previous frame all begins anew.
ScreenProbe screen_probe(PassList& pass_list, const GBuffer& gbuffer);
std::vector<std::string> screen_probe_stages();
