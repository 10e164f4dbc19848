#pragma once

// Ranges of numbers in a scene's files. They are wider than any scene needs, yet far enough from the end of float32
// (3e38): transforms of transforms, sums over lights and squares of radiances stay finite. No range contains NaN.

inline constexpr float any_length = 1e9f;      ///< m, and factors of scale; exact enough in float32 to be of use
inline constexpr float any_far_plane = 1e18f;  ///< m: exporters write it far beyond any_length where they mean none
inline constexpr float any_radiance = 1e12f;   ///< W sr^-1 m^-2, and radiant intensities and irradiances
inline constexpr unsigned any_texture_side = 16384;  ///< texels: what lavapipe and the GPUs of desktops hold
