#include "metrics/disocclusion.h"

#include "core/error.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace {

constexpr double still_tolerance = 0.02, moving_tolerance = 0.05;  // of 1 / depth
constexpr double share_of_tolerance = 1.0 / 8;                     // whatever the normals are
constexpr double still_pixels = 0.01;         // what stands still or moves: as the scene facts have it
constexpr double least_weight = 0.01;         // of a sample that a bilinear fetch blends: motion is rounded, too
constexpr double neighbour_depth_step = 0.1;  // of 1 / depth, between pixels of one surface

struct Inputs {
    const HostImage &view_depth, &normal, &material_id;
    const PreviousFrame& previous;

    const CameraData& camera() const { return previous.camera; }
    glm::dvec2 extent() const { return glm::dvec2(view_depth.extent); }
    bool is_orthographic() const { return camera().frame.z == 1; }
};

bool is_within(const Inputs& in, glm::ivec2 p) {
    return p.x >= 0 && p.y >= 0 && p.x < int(in.view_depth.extent.x) && p.y < int(in.view_depth.extent.y);
}

/// 0 for background.
double inverse_depth(const Inputs& in, glm::ivec2 p) {
    const float depth = *in.view_depth.pixel(unsigned(p.x), unsigned(p.y));
    return depth > 0 ? 1.0 / depth : 0.0;
}

glm::vec3 normal_at(const HostImage& image, glm::ivec2 p) {
    const float* n = image.pixel(unsigned(p.x), unsigned(p.y));
    return {n[0], n[1], n[2]};
}

glm::dvec2 motion_at(const Inputs& in, glm::ivec2 p) {
    const float* m = in.previous.motion.pixel(unsigned(p.x), unsigned(p.y));
    return {m[0], m[1]};
}

/// The point of view space (at z = -1 in perspective) under a point of the screen.
glm::dvec3 view_ray(const glm::mat4& view_from_clip, glm::dvec2 uv) {
    const glm::dvec4 v = glm::dmat4(view_from_clip) * glm::dvec4(uv * 2.0 - 1.0, 0.5, 1.0);
    return glm::dvec3(v) / -v.z;
}

/// Homogeneous: background has w = 0.
glm::dvec4 view_position(const Inputs& in, glm::dvec2 uv, double inverse) {
    if (!in.is_orthographic()) return {view_ray(in.camera().view_from_clip, uv), inverse};
    if (inverse == 0) return {0, 0, -1, 0};
    const glm::dvec4 v = glm::dmat4(in.camera().view_from_clip) * glm::dvec4(uv * 2.0 - 1.0, 0.5, 1.0);
    return {v.x, v.y, -1 / inverse, 1};
}

struct Sample {
    double inverse, rounding;  ///< 1 / depth in the frame before, and by how much it was rounded at most
    glm::vec3 normal;
};

double previous_inverse(const Inputs& in, double device_depth) {
    // Depth alone decides: the off-axis entries of a projection do not move z.
    const glm::dvec4 v = glm::dmat4(in.camera().previous_view_from_clip) * glm::dvec4(0, 0, device_depth, 1);
    return -v.w / v.z;
}

/// The samples that a bilinear fetch of the frame before would blend, strongest first.
std::vector<Sample> samples_before(const Inputs& in, glm::dvec2 uv_before) {
    const glm::dvec2 jitter(in.camera().jitter.z, in.camera().jitter.w);
    const glm::dvec2 place = uv_before * in.extent() - jitter - 0.5, corner = glm::floor(place);
    const glm::dvec2 fraction = place - corner;
    std::vector<std::pair<double, Sample>> weighted;
    for (const glm::ivec2 offset : std::to_array<glm::ivec2>({{0, 0}, {1, 0}, {0, 1}, {1, 1}})) {
        const glm::ivec2 q = glm::ivec2(corner) + offset;
        const double weight = (offset.x ? fraction.x : 1 - fraction.x) * (offset.y ? fraction.y : 1 - fraction.y);
        if (!is_within(in, q) || weight < least_weight) continue;
        const float depth = *in.previous.depth.pixel(unsigned(q.x), unsigned(q.y));
        const bool is_background = depth == in.camera().depth.z;
        const double inverse = is_background ? 0.0 : previous_inverse(in, depth);
        const double rounding =
            std::abs(previous_inverse(in, double(depth) + in.previous.depth_step) - previous_inverse(in, depth));
        weighted.push_back({weight, {inverse, is_background ? 0.0 : rounding, normal_at(in.previous.normal, q)}});
    }
    std::ranges::stable_sort(weighted, std::greater(), &std::pair<double, Sample>::first);
    std::vector<Sample> samples;
    for (const auto& [weight, sample] : weighted) samples.push_back(sample);
    return samples;
}

bool is_same_surface(const Inputs& in, glm::ivec2 p, glm::ivec2 q) {
    const double a = inverse_depth(in, p), b = inverse_depth(in, q);
    return *in.material_id.pixel(unsigned(p.x), unsigned(p.y)) == *in.material_id.pixel(unsigned(q.x), unsigned(q.y)) &&
           glm::dot(normal_at(in.normal, p), normal_at(in.normal, q)) > cos_normal_step &&
           std::abs(a - b) < neighbour_depth_step * std::max(a, b);
}

/// d uv_before / d pixel along a direction, from the neighbours of the same surface; none if there are none.
std::optional<glm::dvec2> motion_derivative(const Inputs& in, glm::ivec2 p, glm::ivec2 direction) {
    glm::ivec2 from = p, to = p;
    if (const glm::ivec2 q = p - direction; is_within(in, q) && is_same_surface(in, p, q)) from = q;
    if (const glm::ivec2 q = p + direction; is_within(in, q) && is_same_surface(in, p, q)) to = q;
    if (from == to) return std::nullopt;
    const glm::dvec2 distance = glm::dvec2(to - from);
    return (distance / in.extent() - (motion_at(in, to) - motion_at(in, from))) / (distance.x + distance.y);
}

/// How far away a surface was that moves by itself; see the header.
double inverse_of_moving(const Inputs& in, glm::ivec2 p, glm::dvec2 uv, glm::dvec2 uv_before,
                         const std::vector<Sample>& samples) {
    const double inverse = inverse_depth(in, p);
    if (in.is_orthographic()) return inverse;
    const auto along_x = motion_derivative(in, p, {1, 0}), along_y = motion_derivative(in, p, {0, 1});
    if (!along_x || !along_y) return inverse;
    const double area = (along_x->x * along_y->y - along_x->y * along_y->x) * in.extent().x * in.extent().y;

    // |n . r| times the scale of the projection.
    const auto facing = [](const glm::mat4& view_from_world, const glm::mat4& view_from_clip, glm::vec3 n,
                           glm::dvec2 at) {
        const glm::dvec3 vs_normal = glm::dmat3(view_from_world) * glm::dvec3(n);
        return std::abs(glm::dot(vs_normal, view_ray(view_from_clip, at)) / double(view_from_clip[0][0]) /
                        double(view_from_clip[1][1]));
    };
    const CameraData& c = in.camera();
    const glm::vec3 normal = normal_at(in.normal, p);
    const auto alike =
        std::ranges::find_if(samples, [&](const Sample& s) { return glm::dot(normal, s.normal) > cos_normal_step; });
    const glm::vec3 normal_before = alike != samples.end() ? alike->normal : normal;
    const double now = facing(c.view_from_world, c.view_from_clip, normal, uv);
    const double before = facing(c.previous_view_from_world, c.previous_view_from_clip, normal_before, uv_before);
    const double magnified = inverse / std::sqrt(before / (now * area));
    return std::isfinite(magnified) ? magnified : inverse;
}

/// Between the samples' values, give or take.
bool is_between(double expected, const std::vector<Sample>& samples, double tolerance) {
    double least = INFINITY, greatest = 0;
    for (const Sample& s : samples) {
        least = std::min(least, s.inverse - s.rounding - tolerance * s.inverse);
        greatest = std::max(greatest, s.inverse + s.rounding + tolerance * s.inverse);
    }
    return expected >= least && expected <= greatest;
}

/// Whether the samples show a surface of that normal at 1 / depth = expected.
bool is_shown(double expected, glm::vec3 normal, const std::vector<Sample>& samples, double tolerance) {
    std::vector<Sample> alike;
    for (const Sample& s : samples)
        if (glm::dot(normal, s.normal) > cos_normal_step) alike.push_back(s);
    return is_between(expected, alike, tolerance) || is_between(expected, samples, tolerance * share_of_tolerance);
}

bool is_disoccluded(const Inputs& in, glm::ivec2 p) {
    const CameraData& c = in.camera();
    const glm::dvec2 uv = (glm::dvec2(p) + 0.5 + glm::dvec2(c.jitter.x, c.jitter.y)) / in.extent();
    const glm::dvec2 uv_before = uv - motion_at(in, p);
    const double inverse = inverse_depth(in, p);
    const glm::dvec4 world = glm::dmat4(c.world_from_view) * view_position(in, uv, inverse);
    const glm::dvec4 still_before = glm::dmat4(c.previous_view_from_world) * world;
    const bool is_on_screen = uv_before.x >= 0 && uv_before.y >= 0 && uv_before.x <= 1 && uv_before.y <= 1;
    if (!is_on_screen || still_before.z >= 0) return true;

    std::vector<Sample> samples = samples_before(in, uv_before);
    if (inverse == 0) return std::ranges::none_of(samples, [](const Sample& s) { return s.inverse == 0; });
    std::erase_if(samples, [](const Sample& s) { return s.inverse == 0; });

    const glm::vec3 normal = normal_at(in.normal, p);
    const glm::dvec4 clip = glm::dmat4(c.previous_clip_from_world) * world;
    const glm::dvec2 still_uv = glm::dvec2(clip) / clip.w * 0.5 + 0.5;
    if (glm::length((still_uv - uv_before) * in.extent()) < still_pixels)
        return !is_shown(still_before.w / -still_before.z, normal, samples, still_tolerance);
    return !is_shown(inverse, normal, samples, moving_tolerance) &&
           !is_shown(inverse_of_moving(in, p, uv, uv_before, samples), normal, samples, moving_tolerance);
}

void check(const Inputs& in) {
    const auto require = [&](const HostImage& image, unsigned channels, const char* what) {
        if (image.extent != in.view_depth.extent || image.channels < channels)
            fail("the mask 'disoccluded' needs ", channels, " channels of ", what, " in ", in.view_depth.extent.x, "x",
                 in.view_depth.extent.y, " pixels, found ", image.channels, " in ", image.extent.x, "x",
                 image.extent.y);
    };
    require(in.normal, 3, "the normal");
    require(in.material_id, 1, "the material id");
    require(in.previous.motion, 2, "the motion");
    require(in.previous.depth, 1, "the previous depth");
    require(in.previous.normal, 3, "the previous normal");
}

}  // namespace

std::vector<uint8_t> disoccluded(const HostImage& view_depth, const HostImage& normal, const HostImage& material_id,
                                 const PreviousFrame& previous) {
    const Inputs in{view_depth, normal, material_id, previous};
    check(in);
    std::vector<uint8_t> inside(view_depth.pixel_count());
    if (previous.camera.frame.w == 0) return inside;
    tbb::parallel_for(0u, view_depth.extent.y, [&](unsigned y) {
        for (unsigned x = 0; x < view_depth.extent.x; ++x)
            inside[size_t(y) * view_depth.extent.x + x] = is_disoccluded(in, glm::ivec2(x, y));
    });
    return inside;
}
