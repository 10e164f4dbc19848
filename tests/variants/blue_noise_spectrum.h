#pragma once
#include "core/host_image.h"

#include <array>
#include <functional>

/// Mean power of the spectrum of a 128x128 image in bands of radial frequency, over the mean of all frequencies: 1 in
/// each band for white noise. The constant term is left out.
constexpr std::array<double, 7> band_edges = {0, 8, 16, 24, 32, 48, 91};  ///< cycles per 128 texels, lower exclusive
using BandEnergies = std::array<double, 6>;

/// A function of the two numbers of a texel, whose image over the plane is looked at.
struct NumberFunction {
    const char* name;
    std::function<double(double, double)> value;
};

/// The numbers, and what samplers make of them: their product, and a coordinate of the point that the disk mapping
/// r = sqrt(u1), phi = 2 pi u2 gives, as sampling of visible normals uses it (Heitz 2018).
const std::array<NumberFunction, 4>& number_functions();

BandEnergies band_energies(const HostImage& numbers, const NumberFunction& function);
