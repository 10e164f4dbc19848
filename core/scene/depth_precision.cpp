#include "core/scene/depth_precision.h"

#include "core/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {}  // namespace

std::string shown_planes(float near, float far) {
    return "near " + number_text(near, 3) + " m, far " + number_text(far, 3) + " m";
}

double depth_step(const CameraData& camera, DepthFormat format, double depth) {
    const double near = camera.depth.x, far = camera.depth.y;
    const bool is_orthographic = camera.frame.z != 0u, is_reversed = camera.depth.w != 0.0f;
    const double change =
        is_orthographic ? 1 / (far - near) : far / (far - near) * near / (depth * depth);  // of a code, 1/m
    const double from_near =
        is_orthographic ? (depth - near) / (far - near) : far / (far - near) * (depth - near) / depth;
    const double code = is_reversed ? 1 - from_near : from_near;
    const double float_step = std::exp2(std::floor(std::log2(std::clamp(code, 1e-37, 1.0 - 0x1p-24))) - 23);
    const double step = format == DepthFormat::d32f  ? float_step
                        : format == DepthFormat::d24 ? 1.0 / 16777215
                                                     : 1.0 / 65535;
    return step / change;
}

std::string precision_warning(const std::string& whose, const CameraData& camera, DepthFormat format, double farthest,
                              const std::string& remedy) {
    // A technique places what it reads within a step of depth. A hundredth of the distance is more than ten pixels are
    // wide in a picture of 1080 rows and 60 degrees, and more than tracers allow for the thickness of things.
    constexpr double largest_share = 0.01;
    const double depth = std::min(farthest, double(camera.depth.y));
    if (!(depth > camera.depth.x)) return "";
    const double step = depth_step(camera, format, depth);
    if (!(step > largest_share * depth)) return "";
    const char* const formats[] = {"d32f", "d24", "d16"};
    const bool reversing_helps = format == DepthFormat::d32f && camera.depth.w == 0.0f && camera.frame.z == 0u;
    return "The planes of " + whose + " (" + shown_planes(camera.depth.x, camera.depth.y) + ") leave depth in " +
           formats[size_t(format)] + " steps of " + number_text(step, 3) + " m at " + number_text(depth, 3) +
           " m, as far as it sees. No hit of any technique is more exact. " +
           (reversing_helps ? "Reversed depth (--reversed-depth, \"depth_direction\": \"reversed\") is exact. " : "") +
           remedy + ".";
}
