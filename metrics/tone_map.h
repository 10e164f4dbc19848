#pragma once
#include "core/host_image.h"

#include <glm/glm.hpp>
#include <string>
#include <vector>

/// How radiance becomes display light in [0, 1] before it is clamped. The three curves are those of HDR-FLIP (Andersson
/// et al. 2021, "Visualizing and Communicating Errors in Rendered Images", Ray Tracing Gems II, chapter 19).
enum class ToneMap { none, aces, hable, reinhard };

inline const std::vector<std::string> tone_map_names = {"none", "aces", "hable", "reinhard"};

/// Fails on a name outside tone_map_names.
ToneMap tone_map_named(const std::string& name);
std::string name_of(ToneMap map);

/// Applied to exposed linear radiance; the result is not clamped.
glm::vec3 tone_mapped(glm::vec3 radiance, ToneMap map);

/// The radiance that the curve maps to 0.85; HDR-FLIP chooses its exposures by it. Fails for ToneMap::none.
double radiance_of_85_percent(ToneMap map);

/// sRGB codes in [0, 1] (IEC 61966-2-1): radiance x 2^exposure_ev, tone map, clamp, sRGB curve. Not quantised.
HostImage display_codes(const HostImage& linear, float exposure_ev, ToneMap map);

/// Rec. 709 luminance of a linear colour, and likewise the luma of a coded one.
constexpr double luminance(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }
