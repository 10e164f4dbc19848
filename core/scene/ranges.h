#pragma once

// What the files of a scene may bring. Wider than any scene, yet so far from the end of float32 (3e38) that transforms
// of transforms, sums over lights and squares of radiances stay finite. A NaN lies in no range.

inline constexpr float any_length = 1e9f;      ///< m, and factors of scale; exact enough in float32 to be of use
inline constexpr float any_far_plane = 1e18f;  ///< m: exporters write it far beyond any_length where they mean none
inline constexpr float any_radiance = 1e12f;   ///< W sr^-1 m^-2, and radiant intensities and irradiances
inline constexpr unsigned any_texture_side = 16384;  ///< texels: what lavapipe and the GPUs of desktops hold
