#pragma once
#include "core/gpu/passes/pass_list.h"

struct GBuffer;

/// A guess at the camera's surroundings from the present and earlier screens. It serves rays that leave the screen, and
/// surfaces too rough for rays. Engines use placed reflection probes for this. Shaders read it by
/// common/screen_probe/lookup.glsl.
///
/// Both images are maps of the directions in world space, of screen_probe_width squared texels within a border of one.
/// A direction that was never on the screen is guessed from seen directions, first from near ones and ones of the same
/// elevation: floors lie below, the sky above, and walls around. Emission is not spread: a lamp does not make another
/// lamp beside it likely.
struct ScreenProbe {
    Image surfaces;  ///< `screen_probe`, rgba32f: a: share of the directions that meet a surface; rgb: a times its
                     ///< diffusely reflected radiance
    Image nearness;  ///< `screen_probe_nearness`, r32f: 1 / distance of these surfaces from the camera (1/m)
};

/// Adds two passes, the stages of screen_probe_stages(). Directions that leave the screen keep their values until they
/// are seen again. Without a previous frame all values begin anew.
ScreenProbe screen_probe(PassList& pass_list, const GBuffer& gbuffer);
std::vector<std::string> screen_probe_stages();
