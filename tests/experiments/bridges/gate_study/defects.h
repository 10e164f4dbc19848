#pragma once
#include "core/host_image.h"

#include <functional>
#include <random>
#include <string>
#include <vector>

/// The frames of one run of a technique, from which a defect makes others. All are specular light of one extent.
struct PlayedFrames {
    std::vector<HostImage> shown, missed;      ///< the technique's, and those of no screen-space reflections
    std::vector<std::vector<uint8_t>> is_new;  ///< of each frame, the pixels that the previous frame did not show
    std::vector<std::vector<uint8_t>> reflects;
};

/// A defect of known strength. Its random numbers are those of the run.
struct Defect {
    std::string kind, strength;
    std::function<std::vector<HostImage>(const PlayedFrames&, std::mt19937&)> apply;
};

/// Nine kinds at graded strengths. The tenth, NaN, is refused before anything is measured.
std::vector<Defect> all_defects();
