#include "metrics/flip.h"

#include "core/error.h"
#include "metrics/flip_color.h"
#include "metrics/flip_filters.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace {

/// What the two images are looked at through: nothing, or an exposure and a tone map.
struct View {
    float scale = 1;
    ToneMap map = ToneMap::none;
};

/// Output pixels [x0, x0 + width) x [y0, y0 + height); their windows reach color_radius beyond.
struct Tile {
    unsigned x0, y0, width, height;
};

/// The scaled Y, Cx, Cz of the tile and its surroundings; pixels outside of the image repeat its border.
struct Opponent {
    FloatPlane y, cx, cz;
};

Opponent load_opponent(const HostImage& image, const View& view, const Tile& tile, unsigned radius) {
    const unsigned width = tile.width + 2 * radius, height = tile.height + 2 * radius;
    Opponent out{FloatPlane(width, height), FloatPlane(width, height), FloatPlane(width, height)};
    const auto clamped = [](unsigned origin, unsigned i, unsigned radius, unsigned size) {
        return unsigned(std::clamp(int64_t(origin) + i - radius, int64_t(0), int64_t(size) - 1));
    };
    for (unsigned j = 0; j < height; ++j) {
        const unsigned y = clamped(tile.y0, j, radius, image.extent.y);
        for (unsigned i = 0; i < width; ++i) {
            const float* p = image.pixel(clamped(tile.x0, i, radius, image.extent.x), y);
            const glm::vec3 light = tone_mapped(glm::max(glm::vec3(p[0], p[1], p[2]), 0.0f) * view.scale, view.map);
            const glm::vec3 o = opponent_from_linear(glm::min(light, 1.0f));
            out.y.row(j)[i] = o.x;
            out.cx.row(j)[i] = o.y;
            out.cz.row(j)[i] = o.z;
        }
    }
    return out;
}

FloatPlane filtered(const FloatPlane& in, const Kernel& horizontal, const Kernel& vertical) {
    return filter_columns(filter_rows(in, horizontal), vertical);
}

/// What the observer can resolve, in the space where colours are compared.
struct PerceivedColor {
    FloatPlane lightness, a, b;
};

PerceivedColor perceived(const Opponent& image, const FlipKernels& k) {
    PerceivedColor out{filtered(image.y, k.achromatic, k.achromatic), filtered(image.cx, k.red_green, k.red_green),
                       filtered(image.cz, k.blue_yellow_1, k.blue_yellow_1)};
    const FloatPlane second = filtered(image.cz, k.blue_yellow_2, k.blue_yellow_2);
    for (size_t i = 0; i < second.values.size(); ++i) {
        const glm::vec3 opponent(out.lightness.values[i], out.a.values[i], out.b.values[i] + second.values[i]);
        const glm::vec3 lab = hunt_lab_from_linear(glm::clamp(linear_from_opponent(opponent), 0.0f, 1.0f));
        out.lightness.values[i] = lab.x;
        out.a.values[i] = lab.y;
        out.b.values[i] = lab.z;
    }
    return out;
}

/// Strengths of edges and of points, from the unfiltered luminance in [0, 1].
struct Features {
    FloatPlane edge, point;
};

/// The part of a plane that is left when `border` pixels are cut from each side.
FloatPlane cropped(const FloatPlane& in, unsigned border) {
    FloatPlane out(in.width - 2 * border, in.height - 2 * border);
    for (unsigned y = 0; y < out.height; ++y) std::copy_n(in.row(y + border) + border, out.width, out.row(y));
    return out;
}

void take_length(FloatPlane& x, const FloatPlane& y) {
    for (size_t i = 0; i < x.values.size(); ++i)
        x.values[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
}

Features features(const Opponent& image, const FlipKernels& k) {
    const FloatPlane luminance = cropped(image.y, k.color_radius - k.feature_radius);
    const FloatPlane blurred_rows = filter_rows(luminance, k.feature_blur);
    Features out{filtered(luminance, k.feature_edge, k.feature_blur),
                 filtered(luminance, k.feature_point, k.feature_blur)};
    take_length(out.edge, filter_columns(blurred_rows, k.feature_edge));
    take_length(out.point, filter_columns(blurred_rows, k.feature_point));
    return out;
}

/// Maps a colour difference, raised to 0.7, to [0, 1]: nearly all of the range to those below 0.4 of the greatest one,
/// which is that of green and blue (section 4.1.4).
float redistributed(float difference) {
    constexpr float exponent = 0.7f, knee = 0.4f, value_at_knee = 0.95f;
    static const float greatest =
        std::pow(hyab(hunt_lab_from_linear({0, 1, 0}), hunt_lab_from_linear({0, 0, 1})), exponent);
    const float limit = knee * greatest;
    const float power = std::pow(difference, exponent);
    if (power < limit) return power * value_at_knee / limit;
    return value_at_knee + (power - limit) / (greatest - limit) * (1 - value_at_knee);
}

/// Raises `out` to LDR-FLIP of the tile where that is greater.
void raise_to_flip(const HostImage& reference, const HostImage& test, const View& view, const Tile& tile,
                   const FlipKernels& kernels, Plane& out) {
    const Opponent r = load_opponent(reference, view, tile, kernels.color_radius);
    const Opponent x = load_opponent(test, view, tile, kernels.color_radius);
    const PerceivedColor color_r = perceived(r, kernels), color_x = perceived(x, kernels);
    const Features feature_r = features(r, kernels), feature_x = features(x, kernels);
    for (unsigned j = 0; j < tile.height; ++j)
        for (unsigned i = 0; i < tile.width; ++i) {
            const size_t at = size_t(j) * tile.width + i;
            const float color =
                redistributed(hyab({color_r.lightness.values[at], color_r.a.values[at], color_r.b.values[at]},
                                   {color_x.lightness.values[at], color_x.a.values[at], color_x.b.values[at]}));
            const float edge = std::abs(feature_r.edge.values[at] - feature_x.edge.values[at]);
            const float point = std::abs(feature_r.point.values[at] - feature_x.point.values[at]);
            // Section 4.2: the exponent 0.5 lifts small differences; 1 / sqrt(2) brings the longest gradient to 1.
            const float feature = std::sqrt(std::max(edge, point) * 0.70710678f);
            double& value = out.row(tile.y0 + j)[tile.x0 + i];
            value = std::max(value, double(std::pow(color, 1 - feature)));
        }
}

Plane greatest_flip(const HostImage& reference, const HostImage& test, const std::vector<View>& views,
                    float pixels_per_degree) {
    if (reference.extent != test.extent || reference.channels != 3 || test.channels != 3)
        fail("FLIP needs two images of one size and of three channels");
    if (!(pixels_per_degree >= 1 && pixels_per_degree <= 1000))
        fail("pixels per degree = ", pixels_per_degree, " is outside [1, 1000]");
    const FlipKernels kernels = flip_kernels(pixels_per_degree);
    Plane map(reference.extent);

    constexpr unsigned size = 128;  // with its surroundings, one plane of a tile takes 86 KiB at the default resolution
    const glm::uvec2 tiles = (map.extent + size - 1u) / size;
    tbb::parallel_for(0u, tiles.x * tiles.y, [&](unsigned t) {
        Tile tile{t % tiles.x * size, t / tiles.x * size, size, size};
        tile.width = std::min(size, map.extent.x - tile.x0);
        tile.height = std::min(size, map.extent.y - tile.y0);
        for (const View& view : views) raise_to_flip(reference, test, view, tile, kernels, map);
    });
    return map;
}

}  // namespace

FlipExposures flip_exposure_range(const HostImage& full_reference, ToneMap map) {
    std::vector<double> luminances;
    for (size_t i = 0; i < full_reference.pixel_count(); ++i) {
        const glm::vec3 c = full_reference.rgb(i);
        if (const double l = luminance(c.r, c.g, c.b); std::isfinite(l)) luminances.push_back(l);
    }
    if (luminances.empty()) fail("cannot choose exposures for HDR-FLIP: the reference has no finite pixel");
    std::ranges::sort(luminances);
    const double median = luminances[luminances.size() / 2], greatest = luminances.back();
    if (!(median > 0))
        fail("cannot choose exposures for HDR-FLIP: the median luminance of the reference is ", median,
             ", but must be above 0; take them from the full image of the scene, or give them");
    const double white = radiance_of_85_percent(map);
    const double start = std::log2(white / greatest), stop = std::log2(white / median);
    return {float(start), float(stop), unsigned(std::max(2.0, std::ceil(stop - start)))};
}

Plane flip_map(const HostImage& reference, const HostImage& test, float pixels_per_degree) {
    return greatest_flip(reference, test, {View{}}, pixels_per_degree);
}

Plane hdr_flip_map(const HostImage& reference, const HostImage& test, const FlipExposures& exposures, ToneMap map,
                   float pixels_per_degree) {
    if (exposures.count < 1) fail("HDR-FLIP needs at least one exposure");
    std::vector<View> views;
    for (unsigned i = 0; i < exposures.count; ++i) {
        const float step = exposures.count > 1 ? (exposures.stop - exposures.start) / float(exposures.count - 1) : 0;
        views.push_back({std::exp2(exposures.start + float(i) * step), map});
    }
    return greatest_flip(reference, test, views, pixels_per_degree);
}
