#pragma once
#include "metrics/cvvdp/calibration.h"

#include <string>
#include <vector>

/// What a display makes of pixel values.
enum class Transfer {
    srgb,   ///< codes in [0, 1]
    linear  ///< light of each channel, cd/m2
};

/// A display with Rec. 709 primaries and the D65 white point, the light of the room on its screen, and a viewer who
/// sees `pixels_per_degree` pixels in one degree at its centre.
struct Display {
    std::string name;
    Transfer transfer;
    double peak;      ///< cd/m2 of white
    double contrast;  ///< peak over black
    double lux;       ///< illuminance on the screen
    double pixels_per_degree;

    double black() const { return peak / contrast; }  ///< cd/m2
    double reflected() const;                         ///< cd/m2 of the room's light: 0.5 % of it, spread evenly
};

/// Those of ColorVideoVDP 0.5.6 that are implemented: standard_4k, standard_fhd, standard_hdr_linear and
/// standard_hdr_linear_dark.
const std::vector<Display>& displays();

/// Fails with Error on an unknown name, with the nearest known one.
const Display& display_named(const std::string& name);

/// The number of pixels in one degree at the centre of a flat screen of `diagonal` inches, seen from `distance` metres.
/// All arguments are above 0.
double pixels_per_degree(double diagonal, unsigned width, unsigned height, double distance);

/// An image's values on a display.
struct Viewing {
    Display display;
    /// cd/m2 of value 1 on a linear display; sRGB displays ignore it. 203 is the graphics white of ITU-R BT.2408.
    double nits_per_unit = 203;
};

/// light[i] = cd/m2 of value[i], a finite value of one of R, G, B, for `count` values. Codes are clamped to [0, 1],
/// linear light to [max(0.005, black), peak]. `light` may be `values`.
void displayed_light(const Viewing& viewing, const float* values, float* light, size_t count);
