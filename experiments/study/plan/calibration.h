#pragma once
#include "core/gpu/device.h"
#include "experiments/study/plan/growth.h"
#include "experiments/study/run.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// What parts of a study take, measured on small images. estimate.h makes estimates of whole studies from it.

inline double pixels_of(glm::uvec2 extent) { return double(extent.x) * double(extent.y); }

/// Seconds that grow with the number of pixels.
struct Line {
    double fixed = 0, per_pixel = 0;
    double at(double pixels) const { return fixed + per_pixel * pixels; }
};

/// What a point of a kind takes.
struct PointRates {
    double compiling = 0;  ///< its shaders
    Line once;             ///< images, and what is measured of the point as a whole
    Line measure;          ///< a frame of a seed
    Growth frame;          ///< rendered: the mean of the first and the last point of the kind
};

/// What a shot takes beside its points.
struct ShotRates {
    Line opening;           ///< its scene, its first frame, what is measured of the truth
    Line guide;             ///< what a reference does before its samples
    double per_sample = 0;  ///< seconds per pixel and sample of a reference
    double probe = 0;       ///< seconds of a reflection probe, if the shot has one
};

/// What was measured on small images, by one of the clocks.
struct Rates {
    std::vector<std::pair<std::string, ShotRates>> shots;  ///< by scenery_of(), in the order of measuring, not empty
    double of_wall = 1;                        ///< seconds of this clock in a second of a reference on the wall
    double of_processor = 1;                   ///< seconds of this clock in a second of work for one processor
    double clock_attempts = 1;                 ///< at each check of the clock
    std::map<std::string, PointRates> points;  ///< by kind_of()

    /// Those of the shot's scenery; else of the first with a scene as made: by a family, or by hand.
    const ShotRates& of(const ShotConfig& shot) const;
};

/// What was measured while other programs took `load_of_others` of all processors, in [0, 1]; none if not reported.
struct Calibration {
    Rates of_wall, of_processors;  ///< by the clock on the wall, and by the time of all processors
    std::optional<double> load_of_others;
};

/// Renders small images of the study's first shot with the first and the last point of each technique and preset, and
/// references of the first shots of up to three other sceneries, those with the most pixels: some ten seconds, longer
/// for many presets and furnished rooms.
Calibration calibrate(Device& device, const Config& config, const RunSettings& settings);

/// Shots whose references take alike: the family of a generated scene, the name of any other, "" of a capture.
std::string scenery_of(const ShotConfig& shot);

/// Points that are alike but for what a design varies.
std::string kind_of(const PointConfig& technique);

/// How often a point is played besides its seeds: with the light of each half of a reference (point_run.cpp).
unsigned plays_of_lit_noise(const Config& config, const ShotConfig& shot);
