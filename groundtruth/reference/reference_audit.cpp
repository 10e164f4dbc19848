#include "groundtruth/reference/reference_audit.h"

#include <cmath>
#include <cstdio>

namespace {

constexpr double standard_errors = 6;
constexpr size_t enough_pixels = 100;

struct PixelZ {
    glm::dvec3 z{0.0};
    unsigned channels = 0;  ///< those that have any variance
};

PixelZ half_z(const ReferenceOutput& output, const HostImage* weights, size_t pixel) {
    PixelZ result;
    if (weights && (weights->values[2 * pixel] == 0 || weights->values[2 * pixel + 1] == 0)) return result;
    for (int c = 0; c < 3; ++c) {
        const size_t i = pixel * 3 + size_t(c);
        if (output.variance.values[i] == 0) continue;
        result.z[c] = (double(output.half_a.values[i]) - output.half_b.values[i]) /
                      (2 * std::sqrt(double(output.variance.values[i])));
        ++result.channels;
    }
    return result;
}

double light_cut(const Reference& reference) {
    const HostImage& light = reference.is_lit_only() ? reference.diffuse.mean : reference.image.mean;
    double cut = 0, all = 0;
    for (size_t i = 0; i < reference.cut_share.values.size(); ++i) {
        const glm::dvec3 radiance = light.rgb(i);
        const double sum = radiance.x + radiance.y + radiance.z;
        cut += reference.cut_share.values[i] * sum, all += sum;
    }
    return all > 0 ? cut / all : 0.0;
}

std::string text(const char* format, auto... values) {
    char buffer[400];
    std::snprintf(buffer, sizeof buffer, format, values...);
    return buffer;
}

std::string warning(const std::string& output, const HalfAudit& audit) {
    const std::string found = "the two halves of the reference's '" + output + "' ";
    const std::string doubt =
        ", though a sound render fails fewer than once in a million times: do not trust the intervals of its noise";
    if (std::abs(audit.correlation) > audit.most_correlation)
        return found +
               text("differ alike in neighbouring pixels (correlation %.3f, at most %.3f if sound)", audit.correlation,
                    audit.most_correlation) +
               doubt;
    return found +
           text("differ by %s than their stated variance (mean z^2 %.3f, %.3f to %.3f if sound)",
                audit.mean_z_squared < audit.low ? "less" : "more", audit.mean_z_squared, audit.low, audit.high) +
           doubt;
}

}  // namespace

bool HalfAudit::is_passed() const {
    return pixels < enough_pixels ||
           (mean_z_squared >= low && mean_z_squared <= high && std::abs(correlation) <= most_correlation);
}

HalfAudit audit_halves(const ReferenceOutput& output, const HostImage* weights) {
    const unsigned width = output.mean.extent.x;
    HalfAudit audit;
    double sum = 0, squares = 0, products = 0, left_squares = 0, right_squares = 0, pairs = 0;
    for (size_t i = 0; i < output.mean.pixel_count(); ++i) {
        const PixelZ z = half_z(output, weights, i);
        if (z.channels == 0) continue;
        ++audit.pixels;
        const double z_squared = glm::dot(z.z, z.z) / z.channels;
        sum += z_squared, squares += z_squared * z_squared;
        if (i % width + 1 == width) continue;
        const PixelZ right = half_z(output, weights, i + 1);
        if (right.channels == 0) continue;
        ++pairs;
        products += glm::dot(z.z, right.z);
        left_squares += glm::dot(z.z, z.z);
        right_squares += glm::dot(right.z, right.z);
    }
    if (audit.pixels == 0) return audit;
    const double n = double(audit.pixels);
    audit.mean_z_squared = sum / n;
    if (left_squares * right_squares > 0) audit.correlation = products / std::sqrt(left_squares * right_squares);
    // The channels of a pixel share their paths, so only pixels count. The variance of z^2 is not taken for less than
    // that of F(1, 14), 2 n^2 (n - 1) / ((n - 2)^2 (n - 4)) with n = 14: few pixels can understate it.
    const double of_normal = 2.0 * 14 * 14 * 13 / (12 * 12 * 10);
    const double found = squares / n - audit.mean_z_squared * audit.mean_z_squared;
    const double error = standard_errors * std::sqrt(std::max(of_normal, found) / n);
    audit.low = 1 - error;
    audit.high = 14.0 / 12 + error;
    audit.most_correlation = pairs > 0 ? standard_errors / std::sqrt(pairs) : 0;
    return audit;
}

ReferenceAudit audit_reference(const Reference& reference) {
    ReferenceAudit audit;
    if (!reference.is_lit_only()) audit.outputs.push_back({"image", audit_halves(reference.image)});
    audit.outputs.push_back({"diffuse", audit_halves(reference.diffuse)});
    if (!reference.is_lit_only()) {
        audit.outputs.push_back({"specular", audit_halves(reference.specular)});
        audit.outputs.push_back({"incident", audit_halves(reference.incident, &reference.lobe_samples)});
    }
    if (!reference.ladder.is_empty()) {
        const TruthLadder& ladder = reference.ladder;
        audit.outputs.push_back({"camera_radiance", audit_halves(ladder.camera_radiance, &reference.lobe_samples)});
        audit.outputs.push_back({"on_screen", audit_halves(ladder.on_screen, &reference.lobe_samples)});
    }
    for (const auto& [name, halves] : audit.outputs)
        if (!halves.is_passed()) audit.warnings.push_back(warning(name, halves));
    audit.light_cut = light_cut(reference);
    if (audit.light_cut > largest_light_cut)
        audit.warnings.push_back(
            text("about %.2g %% of the reference's light is missing, on paths of more than max_depth "
                 "reflections: raise max_depth",
                 100 * audit.light_cut));
    return audit;
}
