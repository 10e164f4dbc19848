#include "experiments/study/measuring/frames/lit_filter.h"

#include "core/error.h"
#include "groundtruth/paths/path_tracer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace {

constexpr int window = 7, patch = 2;      // pixels to each side
constexpr int border = window + patch;    // of the planes, so that no pixel in reach is outside
constexpr float damping = 0.45f * 0.45f;  // k^2: how many variances a difference is measured in
constexpr float least_albedo = 0.01f;     // below it light would be noise over nothing
constexpr float plane_share = 0.01f;  // of the distance from the camera: how far a point may be off a surface's plane
constexpr int rows_of_task = 16;

/// Values of one channel with a border that repeats the image's edge, or is 0.
class Plane {
public:
    Plane(glm::uvec2 extent, bool repeats_edge) : extent_(extent), stride_(int(extent.x) + 2 * border) {
        values_.resize(size_t(stride_) * (extent.y + 2 * border));
        repeats_edge_ = repeats_edge;
    }
    template <class Value>
    void fill(const Value& value) {
        for (int y = -border; y < int(extent_.y) + border; ++y)
            for (int x = -border; x < int(extent_.x) + border; ++x) {
                const int inside_x = std::clamp(x, 0, int(extent_.x) - 1),
                          inside_y = std::clamp(y, 0, int(extent_.y) - 1);
                const bool is_inside = x == inside_x && y == inside_y;
                row(y)[x] = is_inside || repeats_edge_ ? value(size_t(inside_y) * extent_.x + inside_x) : 0.0f;
            }
    }
    float* row(int y) { return values_.data() + size_t(y + border) * stride_ + border; }
    const float* row(int y) const { return values_.data() + size_t(y + border) * stride_ + border; }

private:
    glm::uvec2 extent_;
    int stride_;
    bool repeats_edge_;
    std::vector<float> values_;
};

using Planes = std::vector<Plane>;

/// What weights and means are made of.
struct Inputs {
    glm::uvec2 extent;
    std::array<Planes, 2> light;  ///< by half and channel
    Planes variance;              ///< of a half, by channel, mean over 3 x 3 pixels
    Planes normal, position;      ///< by axis
    Plane is_lit;                 ///< 1 or 0
    Plane reach;                  ///< 1 / how far a point may be off the pixel's plane (1/m)
};

bool is_lit(const LitSurfaces& surfaces, size_t i) {
    const glm::vec3 albedo = surfaces.albedo.rgb(i);
    return std::max({albedo.x, albedo.y, albedo.z}) > least_albedo;
}

glm::vec3 divisor_at(const LitSurfaces& surfaces, size_t i) {
    return max(surfaces.albedo.rgb(i), glm::vec3(least_albedo));
}

Inputs inputs_of(const ReferenceOutput& lit, const LitSurfaces& surfaces) {
    const glm::uvec2 extent = lit.mean.extent;
    Inputs in{.extent = extent,
              .light = {},
              .variance = {},
              .normal = {},
              .position = {},
              .is_lit = Plane(extent, false),
              .reach = Plane(extent, true)};
    const auto add = [&](Planes& planes, const auto& value) { planes.emplace_back(extent, true).fill(value); };
    in.is_lit.fill([&](size_t i) { return is_lit(surfaces, i) ? 1.0f : 0.0f; });
    in.reach.fill([&](size_t i) { return 1.0f / (plane_share * surfaces.distance.values[i] + 1e-6f); });
    for (int c = 0; c < 3; ++c) {
        for (const int half : {0, 1})
            add(in.light[half], [&](size_t i) {
                const HostImage& image = half == 0 ? lit.half_a : lit.half_b;
                if (!is_lit(surfaces, i)) return 0.0f;
                return (image.rgb(i)[c] - surfaces.emitted.rgb(i)[c]) / divisor_at(surfaces, i)[c];
            });
        Plane variance(extent, true);
        variance.fill([&](size_t i) {
            const float divisor = divisor_at(surfaces, i)[c];
            return is_lit(surfaces, i) ? 2.0f * lit.variance.rgb(i)[c] / (divisor * divisor) : 0.0f;
        });
        add(in.variance, [&](size_t i) {
            const int x = int(i % extent.x), y = int(i / extent.x);
            float sum = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) sum += variance.row(y + dy)[x + dx];
            return sum / 9.0f;
        });
        add(in.normal, [&](size_t i) { return surfaces.normal.rgb(i)[c]; });
        add(in.position, [&](size_t i) { return surfaces.position.rgb(i)[c]; });
    }
    return in;
}

/// Near e^-d for d >= 0, of which loops are vector code: (1 + x + x^2 / 2)^-8 with x = d / 8. Within 0.001 below d
/// = 10.
float decay(float d) {
    float grown = 1.0f + d * (1.0f / 8) * (1.0f + d * (1.0f / 16));
    for (int doubling = 0; doubling < 3; ++doubling) grown *= grown;
    return 1.0f / grown;
}

/// Some rows of the image. Buffers are of its width with the patch's border.
class Rows {
public:
    Rows(const Inputs& in, int first, int end)
        : in_(in), first_(first), end_(end), width_(int(in.extent.x)), stride_(width_ + 2 * patch) {
        const size_t pixels = size_t(width_) * (end - first);
        for (int half : {0, 1}) {
            distances_[half].resize(size_t(stride_) * (end - first + 2 * patch));
            sums_[half].assign(3 * pixels, 0.0f), weights_[half].assign(pixels, 0.0f);
        }
        column_.resize(stride_);
    }

    void run(std::array<HostImage, 2>& result) {
        for (int dy = -window; dy <= window; ++dy)
            for (int dx = -window; dx <= window; ++dx) {
                find_distances(dx, dy);
                for (int y = first_; y < end_; ++y) add_row(y, dx, dy);
            }
        for (int half : {0, 1})
            for (int y = first_; y < end_; ++y)
                for (int x = 0; x < width_; ++x) {
                    const size_t own = size_t(y - first_) * width_ + x;
                    for (int c = 0; c < 3; ++c)
                        result[half].pixel(unsigned(x), unsigned(y))[c] =
                            sums_[half][3 * own + c] / std::max(weights_[half][own], 1e-20f);
                }
    }

private:
    float* distance_row(int half, int y) { return &distances_[half][size_t(y - first_ + patch) * stride_ + patch]; }

    /// Squared differences of the light at p and p + (dx, dy), beyond what their variances explain, in variances.
    /// Deviation: the neighbour's variance is at most the pixel's in the denominator, too. A bright path that one half
    /// has raises the variance of its pixel; as printed all around would take it for alike, and it would count too
    /// much.
    void find_distances(int dx, int dy) {
        for (int half : {0, 1})
            for (int y = first_ - patch; y < end_ + patch; ++y) {
                float* out = distance_row(half, y);
                std::fill(out - patch, out + width_ + patch, 0.0f);
                for (int c = 0; c < 3; ++c) {
                    const float *p = in_.light[half][c].row(y), *q = in_.light[half][c].row(y + dy) + dx;
                    const float *vp = in_.variance[c].row(y), *vq = in_.variance[c].row(y + dy) + dx;
                    for (int x = -patch; x < width_ + patch; ++x) {
                        const float difference = p[x] - q[x], noise = vp[x] + std::min(vp[x], vq[x]);
                        out[x] += (difference * difference - noise) / (1e-12f + damping * noise);
                    }
                }
            }
    }

    void add_row(int y, int dx, int dy) {
        constexpr float scale = 1.0f / (3 * (2 * patch + 1) * (2 * patch + 1));  // mean over channels and patch
        const Inputs& in = in_;
        for (int half : {0, 1}) {
            std::ranges::fill(column_, 0.0f);
            float* column = column_.data() + patch;
            for (int j = -patch; j <= patch; ++j) {
                const float* row = distance_row(half, y + j);
                for (int x = -patch; x < width_ + patch; ++x) column[x] += row[x];
            }
            // The weights of one half are for the values of the other.
            const int other = 1 - half;
            float* sums = &sums_[other][size_t(y - first_) * width_ * 3];
            float* weights = &weights_[other][size_t(y - first_) * width_];
            const float* lit = in.is_lit.row(y + dy) + dx;
            const float* reach = in.reach.row(y);
            for (int x = 0; x < width_; ++x) {
                float distance = 0;
                for (int i = -patch; i <= patch; ++i) distance += column[x + i];
                float cosine = 0, off_plane = 0;
                for (int c = 0; c < 3; ++c) {
                    const float n = in.normal[c].row(y)[x];
                    cosine += n * in.normal[c].row(y + dy)[x + dx];
                    off_plane += n * (in.position[c].row(y + dy)[x + dx] - in.position[c].row(y)[x]);
                }
                off_plane *= reach[x];
                float same_normal = std::max(cosine, 0.0f);
                for (int power = 0; power < 6; ++power) same_normal *= same_normal;  // ^64: 0.5 at 8 degrees
                const float weight =
                    lit[x] * decay(std::max(distance * scale, 0.0f)) * same_normal * decay(off_plane * off_plane);
                weights[x] += weight;
                for (int c = 0; c < 3; ++c) sums[3 * x + c] += weight * in.light[other][c].row(y + dy)[x + dx];
            }
        }
    }

    const Inputs& in_;
    int first_, end_, width_, stride_;
    std::array<std::vector<float>, 2> distances_, sums_, weights_;
    std::vector<float> column_;
};

}  // namespace

LitSurfaces lit_surfaces(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent) {
    PathTracerSettings settings;
    settings.learns_lights = false;
    const PathTracer tracer(scene, pose, camera, extent, settings);
    LitSurfaces surfaces{.albedo = HostImage(extent, 3),
                         .emitted = HostImage(extent, 3),
                         .normal = HostImage(extent, 3),
                         .position = HostImage(extent, 3),
                         .distance = HostImage(extent, 1)};
    tbb::parallel_for(0u, extent.y, [&](unsigned y) {
        for (unsigned x = 0; x < extent.x; ++x) {
            const FirstHit hit = tracer.first_hit(x, y);
            const size_t i = size_t(y) * extent.x + x;
            surfaces.emitted.set_rgb(i, hit.emitted);
            if (!hit.is_hit || hit.is_unlit) continue;
            surfaces.albedo.set_rgb(i, hit.base_color * (1.0f - hit.metalness));
            surfaces.normal.set_rgb(i, hit.normal), surfaces.position.set_rgb(i, hit.position);
            surfaces.distance.values[i] = hit.distance;
        }
    });
    return surfaces;
}

FilteredLit filter_lit(const ReferenceOutput& lit, const LitSurfaces& surfaces) {
    if (surfaces.albedo.extent != lit.mean.extent) fail("surfaces of a lit colour have another size than it");
    const Inputs in = inputs_of(lit, surfaces);
    std::array<HostImage, 2> light = {HostImage(in.extent, 3), HostImage(in.extent, 3)};
    tbb::parallel_for(tbb::blocked_range<int>(0, int(in.extent.y), rows_of_task),
                      [&](const auto& range) { Rows(in, range.begin(), range.end()).run(light); });
    FilteredLit filtered{.mean = lit.mean, .half_a = lit.half_a, .half_b = lit.half_b};
    for (size_t i = 0; i < lit.mean.pixel_count(); ++i) {
        if (!is_lit(surfaces, i)) continue;
        const glm::vec3 albedo = divisor_at(surfaces, i), emitted = surfaces.emitted.rgb(i);
        filtered.half_a.set_rgb(i, light[0].rgb(i) * albedo + emitted);
        filtered.half_b.set_rgb(i, light[1].rgb(i) * albedo + emitted);
        filtered.mean.set_rgb(i, 0.5f * (filtered.half_a.rgb(i) + filtered.half_b.rgb(i)));
    }
    return filtered;
}
