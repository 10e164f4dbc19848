#ifndef SHARED_PREFILTERED_ENVIRONMENT_H
#define SHARED_PREFILTERED_ENVIRONMENT_H
#include "core/shared/language.h"

// Where the lat-long maps of the prefiltered environment lie in their atlas, one below the other, narrower ones at the
// left. Level k >= 1 holds perceptual roughness k / prefilter_roughness_steps; a mirror reads the environment itself.
// The last map, level prefilter_irradiance_level, holds irradiance / pi.

const uint prefilter_roughness_steps = 16u;
const uint prefilter_irradiance_level = 17u;
const uint prefilter_atlas_width = 512u;
const uint prefilter_atlas_height = 1280u;

/// Texels around the equator: about five across the half-height width (2.6 alpha, in radians) of the reflection lobe.
SHARED uint prefilter_width(uint level) {
    if (level <= 2u) return 512u;
    if (level <= 4u) return 256u;
    if (level <= 6u || level == prefilter_irradiance_level) return 128u;
    return 64u;
}

/// First row of the level in the atlas; each has half as many rows as columns.
SHARED uint prefilter_row(uint level) {
    uint row = 0u;
    for (uint below = 1u; below < level; ++below) row += prefilter_width(below) / 2u;
    return row;
}

/// The two levels, `level` and the next, between which a perceptual roughness lies.
struct PrefilterBlend {
    uint level;      ///< 0: the environment itself
    float fraction;  ///< of the next level
};

SHARED PrefilterBlend prefilter_blend(float roughness) {
    float position = clamp(roughness, 0.0f, 1.0f) * float(prefilter_roughness_steps);
    PrefilterBlend blend;
    blend.level = min(uint(position), prefilter_roughness_steps - 1u);
    blend.fraction = position - float(blend.level);
    return blend;
}

/// The four texels of the atlas around a point of a map. Columns wrap, rows end at the poles.
struct PrefilterTap {
    uvec2 columns, rows;  ///< left and right, upper and lower
    vec2 fraction;        ///< of the right column and of the lower row
};

SHARED PrefilterTap prefilter_tap(uint level, vec2 latlong_uv) {
    uint width = prefilter_width(level);
    uint height = width / 2u;
    float x = latlong_uv.x * float(width) - 0.5f;
    float y = clamp(latlong_uv.y * float(height) - 0.5f, 0.0f, float(height) - 1.0f);
    uint left = uint(int(floor(x)) + int(width)) % width;
    uint upper = min(uint(y), height - 1u);
    PrefilterTap tap;
    tap.columns = uvec2(left, (left + 1u) % width);
    tap.rows = prefilter_row(level) + uvec2(upper, min(upper + 1u, height - 1u));
    tap.fraction = vec2(x - floor(x), y - float(upper));
    return tap;
}
#endif
