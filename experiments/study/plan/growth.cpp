#include "experiments/study/plan/growth.h"

#include <algorithm>
#include <cmath>

double Growth::at(double pixels) const { return fixed + scale * std::pow(pixels, power); }

Growth growth_through(const std::array<double, 3>& pixels, const std::array<double, 3>& seconds) {
    constexpr double least_growth = 1.2;  // noise of a few frames' times stays below
    if (seconds[2] < least_growth * seconds[0]) return {.fixed = (seconds[0] + seconds[1] + seconds[2]) / 3};
    /// Of what is added from the first size to the last, the share that is added up to the second: falls with the
    /// power.
    const auto share_at = [&](double power) {
        const auto grown = [&](double n) { return std::pow(n, power) - std::pow(pixels[0], power); };
        return grown(pixels[1]) / grown(pixels[2]);
    };
    const double share = (seconds[1] - seconds[0]) / (seconds[2] - seconds[0]);
    double least = 1, most = 1.5;
    for (int i = 0; i < 40; ++i) {
        const double power = (least + most) / 2;
        (share_at(power) > share ? least : most) = power;
    }
    Growth growth{.power = (least + most) / 2};
    const double first = std::pow(pixels[0], growth.power), last = std::pow(pixels[2], growth.power);
    growth.scale = (seconds[2] - seconds[0]) / (last - first);
    // Where the line through both would begin below 0, all of the largest size grows.
    growth.fixed = std::max(seconds[2] - growth.scale * last, 0.0);
    if (growth.fixed == 0) growth.scale = seconds[2] / last;
    return growth;
}
