#pragma once
#include "metrics/cvvdp/calibration.h"

#include <array>
#include <cstddef>

inline constexpr unsigned sensitivity_nodes = 32;

/// log10 of the sensitivity to Weber contrast of each channel, [channel][background][frequency]. Backgrounds of 0.005
/// to 10000 cd/m2 and frequencies of 0.1 to 64 cycles per degree, both in equal steps of their logarithm.
using SensitivityTable = PerCvvdpChannel<std::array<std::array<float, sensitivity_nodes>, sensitivity_nodes>>;
const SensitivityTable& sensitivity_table();

/// The sensitivity of each channel to contrasts of one spatial frequency, by background.
class BandSensitivity {
public:
    /// `frequency` in cycles per degree, above 0. Beyond the table's frequencies its last segment is continued.
    BandSensitivity(double frequency, const CvvdpCalibration& calibration);

    /// out[x] = sensitivity of `channel` at background 2^log2_background[x] cd/m2, limited to the table's.
    void row(unsigned channel, const float* log2_background, float* out, unsigned width) const;

private:
    PerCvvdpChannel<std::array<float, sensitivity_nodes>> log2_at_background_;
};
