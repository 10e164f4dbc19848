#pragma once
#include "core/scene/scene.h"
#include "core/shared/prefiltered_environment.h"

/// The environment averaged over the GGX reflection lobe seen along the normal (n = v = r: Karis 2013, "Real Shading in
/// Unreal Engine 4"), for 16 steps of roughness, and its irradiance. A constant environment needs no maps.
struct PrefilteredEnvironment {
    HostImage atlas;  ///< RGB, laid out as core/shared/prefiltered_environment.h says; empty for a constant environment
};

/// Uses all cores for some tenths of a second. Every texel is a deterministic sum over the whole sphere, fine near the
/// lobe's peak and coarse in its tails, so that no bright texel is missed or met by chance.
PrefilteredEnvironment prefilter_environment(const Environment& environment);

/// Mean radiance over the visible-normal reflection lobe above the horizon. The lobe is treated as round about the
/// mirror direction, `direction` (unit, world space). `roughness` is perceptual, in [0, 1].
glm::vec3 mean_over_lobe(const Environment& environment, const PrefilteredEnvironment& prefiltered, glm::vec3 direction,
                         float roughness);
