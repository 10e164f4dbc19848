#include "metrics/cvvdp/display.h"

#include "core/near_miss.h"
#include "metrics/cvvdp/fast_power.h"

#include <algorithm>
#include <cmath>
#include <numbers>

double Display::reflected() const { return lux / std::numbers::pi * 0.005; }

double pixels_per_degree(double diagonal, unsigned width, unsigned height, double distance) {
    const double metres_per_inch = 0.0254;
    const double screen_width = metres_per_inch * diagonal * width / std::hypot(double(width), double(height));
    const double radians = 2 * std::atan(0.5 * screen_width / width / distance);
    return std::numbers::pi / 180 / radians;
}

const std::vector<Display>& displays() {
    static const std::vector<Display> all = [] {
        const double ppd_4k = pixels_per_degree(30, 3840, 2160, 0.7472);
        const double ppd_fhd = pixels_per_degree(24, 1920, 1080, 0.6);
        return std::vector<Display>{
            {"standard_4k", Transfer::srgb, 200, 1000, 250, ppd_4k},
            {"standard_fhd", Transfer::srgb, 200, 1000, 250, ppd_fhd},
            {"standard_hdr_linear", Transfer::linear, 1500, 1e6, 10, ppd_4k},
            {"standard_hdr_linear_dark", Transfer::linear, 1500, 1e6, 0, ppd_4k},
        };
    }();
    return all;
}

const Display& display_named(const std::string& name) { return find_named(displays(), name, "no display named"); }

namespace {

void light_of_codes(const float* codes, float* light, size_t count, float scale, float offset) {
    for (size_t i = 0; i < count; ++i) {
        const float code = std::min(std::max(codes[i], 0.0f), 1.0f);
        const float power = fast_power((code + 0.055f) * (1 / 1.055f), 2.4f);
        light[i] = scale * (code > 0.04045f ? power : code * (1 / 12.92f)) + offset;
    }
}

void light_of_radiance(const float* radiance, float* light, size_t count, float scale, float low, float high,
                       float offset) {
    for (size_t i = 0; i < count; ++i) light[i] = std::min(std::max(scale * radiance[i], low), high) + offset;
}

}  // namespace

void displayed_light(const Viewing& viewing, const float* values, float* light, size_t count) {
    const Display& d = viewing.display;
    if (d.transfer == Transfer::srgb)
        light_of_codes(values, light, count, float(d.peak - d.black()), float(d.black() + d.reflected()));
    else
        light_of_radiance(values, light, count, float(viewing.nits_per_unit), float(std::max(0.005, d.black())),
                          float(d.peak), float(d.reflected()));
}
