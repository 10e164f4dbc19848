#include "tests/variants/blue_noise_spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace {

constexpr int size = 128;
using Plane = std::vector<std::complex<double>>;

/// Discrete Fourier transform (Cooley and Tukey 1965) of a power of 2 of values that lie `stride` apart.
Plane transform(const std::complex<double>* values, size_t count, size_t stride) {
    if (count == 1) return {*values};
    const Plane even = transform(values, count / 2, stride * 2);
    const Plane odd = transform(values + stride, count / 2, stride * 2);
    Plane result(count);
    for (size_t k = 0; k < count / 2; ++k) {
        const std::complex<double> turned = std::polar(1.0, -2 * std::numbers::pi * double(k) / double(count)) * odd[k];
        result[k] = even[k] + turned;
        result[k + count / 2] = even[k] - turned;
    }
    return result;
}

/// Of each column, as a row of the result: applied twice it is the transform of the plane.
Plane transform_columns(const Plane& plane) {
    Plane result;
    for (int column = 0; column < size; ++column) {
        const Plane row = transform(&plane[column], size, size);
        result.insert(result.end(), row.begin(), row.end());
    }
    return result;
}

double radius_of(int i) {
    const int x = i % size, y = i / size;
    return std::hypot(std::min(x, size - x), std::min(y, size - y));
}

}  // namespace

const std::array<NumberFunction, 4>& number_functions() {
    static const std::array<NumberFunction, 4> functions = {{
        {"first", [](double u, double) { return u; }},
        {"second", [](double, double v) { return v; }},
        {"product", [](double u, double v) { return (u - 0.5) * (v - 0.5); }},
        {"disk", [](double u, double v) { return std::sqrt(u) * std::cos(2 * std::numbers::pi * v); }},
    }};
    return functions;
}

BandEnergies band_energies(const HostImage& numbers, const NumberFunction& function) {
    Plane plane(numbers.pixel_count());
    for (size_t i = 0; i < plane.size(); ++i)
        plane[i] = function.value(numbers.values[i * 2], numbers.values[i * 2 + 1]);
    const Plane spectrum = transform_columns(transform_columns(plane));

    BandEnergies energies{}, counts{};
    double all = 0;
    for (int i = 1; i < size * size; ++i) {
        const double power = std::norm(spectrum[i]);
        const auto edge = std::lower_bound(band_edges.begin() + 1, band_edges.end(), radius_of(i));
        const size_t band = size_t(edge - band_edges.begin() - 1);
        energies[band] += power;
        counts[band] += 1;
        all += power;
    }
    for (size_t band = 0; band < energies.size(); ++band) energies[band] /= counts[band] * all / (size * size - 1);
    return energies;
}
