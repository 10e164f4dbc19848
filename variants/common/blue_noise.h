#pragma once
#include "core/gpu/passes/pass_list.h"

#include <memory>

/// How a texel's two numbers move from frame to frame: both by the golden ratio, so that their difference never changes
/// and the texel stays on one wrapped diagonal of the unit square (AMD FidelityFX SSSR 1.5), or along the R2 sequence,
/// which covers the square (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences").
/// golden_diagonal_from_half: as golden_diagonal, 1/2 later (DiligentFX, whose pass fills a second image, too, with an
/// R2 sequence along a Hilbert curve for other effects than reflections; it is left out).
/// white: none; numbers are independent in every texel and frame, and the table is not looked at.
enum class NoiseShift { golden_diagonal, golden_diagonal_from_half, r2, white };

/// How they are stored: as k / 255, so that exact 0 and 1 occur (as SSSR 1.5), or in float32, in [0, 1).
enum class NoisePrecision { bits_8, float_32 };

/// What runs the pass: techniques for machines without compute shaders draw it.
enum class NoiseStage { compute, fragment };

/// Random numbers for the samples of one frame: 128x128 pairs, blue over the image plane, uniform over the unit square.
/// One per technique; it uploads the table that all frames derive from when a pass_list has none yet.
class BlueNoise {
public:
    /// Adds the pass "common/blue_noise" and returns its image `blue_noise`, rg8 or rg32f: two numbers per texel; pixel
    /// (x, y) takes texel (x mod 128, y mod 128). They are a function of frame index and seed in the camera block:
    /// their period is 256 frames; a seed other than 0 moves the table by whole texels and all numbers by a rotation of
    /// the unit square (Cranley and Patterson 1976), so that every pixel's numbers are independent between seeds. Fails
    /// with Error if the file of the table is missing or not of its size.
    Image render(PassList& pass_list, NoiseShift shift, NoisePrecision precision = NoisePrecision::bits_8,
                 NoiseStage stage = NoiseStage::compute);

    /// The table under the name `blue_noise`, for passes whose shaders name it and never look at it.
    Image table(PassList& pass_list) { return uploaded(pass_list).as("blue_noise"); }

private:
    Image uploaded(PassList& pass_list);
    std::weak_ptr<ImageStorage> uploaded_table_;
};

/// The committed table: 128x128 pairs of codes v in 0..255, as v / 255 in two channels. See blue_noise_table.md.
HostImage blue_noise_table();

constexpr unsigned blue_noise_texture_width = 64;

/// The committed texture: 64x64 texels of four bytes, row by row, blue noise in each channel alone. See
/// blue_noise_table.md.
std::vector<uint8_t> blue_noise_texture();
