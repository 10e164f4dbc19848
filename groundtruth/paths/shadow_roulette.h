#pragma once

/// Light samples that bring less than this share of their pixel's light play roulette before their shadow ray is
/// traced. Measured over 0.25, 0.5 and 1 in ten scenes.
inline constexpr float shadow_window = 0.5f;

/// The probability with which the shadow ray of a light sample is traced. What the sample brings if the light is
/// visible is divided by the probability, so that no mean depends on it, and no sample brings more than the window.
/// `promised`: what the sample brings if the light is visible, over the pixel's expected light (luminances). `plays`:
/// the latter is known. Branchless, for vector loops.
inline float shadow_ray_chance(float promised, bool plays) {
    const float chance = promised * (1.0f / shadow_window);
    return (plays & (chance > 0.0f) & (chance < 1.0f)) ? chance : 1.0f;
}
