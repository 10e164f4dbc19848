#include "metrics/tone_map.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/png.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace {

/// (a0 c^2 + a1 c) / (b0 c^2 + b1 c + b2).
struct RationalCurve {
    float a0, a1, b0, b1, b2;
};
/// Narkowicz 2016, "ACES filmic tone mapping curve", with its exposure of 0.6 multiplied in (0.36 x 2.51, 0.6 x 0.03,
/// ...).
constexpr RationalCurve aces_curve{0.9036f, 0.018f, 0.8748f, 0.354f, 0.14f};
/// Hable 2010, "Uncharted 2: HDR Lighting", brought to one fraction and scaled to its white point.
constexpr RationalCurve hable_curve{0.231683f, 0.013791f, 0.18f, 0.3f, 0.018f};

glm::vec3 apply(const RationalCurve& k, glm::vec3 c) {
    return (k.a0 * c * c + k.a1 * c) / (k.b0 * c * c + k.b1 * c + k.b2);
}

/// The larger root of curve(c) = t.
double inverse(const RationalCurve& k, double t) {
    const double a = k.a0 - t * k.b0, b = k.a1 - t * k.b1, c = -t * k.b2;
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

}  // namespace

ToneMap tone_map_named(const std::string& name) {
    const auto found = std::ranges::find(tone_map_names, name);
    if (found == tone_map_names.end()) fail("no tone map named '", name, "'", suggestion(name, tone_map_names));
    return ToneMap(found - tone_map_names.begin());
}

std::string name_of(ToneMap map) { return tone_map_names[size_t(map)]; }

glm::vec3 tone_mapped(glm::vec3 radiance, ToneMap map) {
    switch (map) {
        case ToneMap::aces:
            return apply(aces_curve, radiance);
        case ToneMap::hable:
            return apply(hable_curve, radiance);
        case ToneMap::reinhard:
            return radiance / (1.0f + float(luminance(radiance.r, radiance.g, radiance.b)));
        case ToneMap::none:
            break;
    }
    return radiance;
}

double radiance_of_85_percent(ToneMap map) {
    constexpr double t = 0.85;  // Andersson et al. 2021, section 19.4
    if (map == ToneMap::aces) return inverse(aces_curve, t);
    if (map == ToneMap::hable) return inverse(hable_curve, t);
    if (map == ToneMap::reinhard) return t / (1 - t);
    fail("HDR-FLIP needs a tone map: 'none' has no shoulder to choose exposures by; known are: aces, hable, reinhard");
}

HostImage display_codes(const HostImage& linear, float exposure_ev, ToneMap map) {
    HostImage codes(linear.extent, 3);
    const float scale = std::exp2(exposure_ev);
    tbb::parallel_for(size_t(0), size_t(linear.extent.y), [&](size_t y) {
        for (size_t i = y * linear.extent.x; i < (y + 1) * linear.extent.x; ++i) {
            const glm::vec3 light = tone_mapped(glm::max(linear.rgb(i), 0.0f) * scale, map);
            for (int c = 0; c < 3; ++c) codes.values[i * 3 + c] = srgb_from_linear(std::clamp(light[c], 0.0f, 1.0f));
        }
    });
    return codes;
}
