#pragma once
#include "core/gpu/passes/pass_list.h"

#include <memory>

/// How a texel's two numbers move from frame to frame.
/// - golden_diagonal: both by the golden ratio, so that the texel stays on one wrapped diagonal of the unit square (AMD
///   FidelityFX SSSR 1.5)
/// - golden_diagonal_from_half: the same, 1/2 later (DiligentFX, without the second image that its pass fills for other
///   effects)
/// - r2: along the R2 sequence, which covers the square (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom
///   Sequences")
/// - white: numbers are independent in every texel and frame, and the table is not read
enum class NoiseShift { golden_diagonal, golden_diagonal_from_half, r2, white };

/// How the numbers are stored: as k / 255, which includes 0 and 1 (SSSR 1.5), or in float32, in [0, 1).
enum class NoisePrecision { bits_8, float_32 };

/// The stage that runs the pass: techniques for machines without compute shaders use a fragment shader.
enum class NoiseStage { compute, fragment };

/// Random numbers for the samples of one frame: 128x128 pairs, blue over the image plane, uniform over the unit square.
/// Have one per technique. It uploads the table, from which all frames derive, if a pass_list has none yet.
class BlueNoise {
public:
    /// Adds the pass "common/blue_noise" and returns its image `blue_noise`, rg8 or rg32f: two numbers per texel; pixel
    /// (x, y) takes texel (x mod 128, y mod 128). They depend on frame index and seed in the camera block, with a
    /// period of 256 frames. A seed other than 0 moves the table by whole texels and all numbers by a rotation of the
    /// unit square (Cranley and Patterson 1976). A pixel's numbers are therefore independent between seeds. Fails with
    /// Error if the file of the table is missing or not of its size.
    Image render(PassList& pass_list, NoiseShift shift, NoisePrecision precision = NoisePrecision::bits_8,
                 NoiseStage stage = NoiseStage::compute);

    /// The table under the name `blue_noise`, for passes whose shaders declare it but never read it.
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
