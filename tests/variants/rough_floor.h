#pragma once
#include "tests/variants/lobe_quadrature.h"
#include "tests/variants/synthetic_gbuffer.h"

#include <cmath>
#include <random>

/// mirror_floor with a rough floor: what its pixels reflect of the wall that is seen, by quadrature over the lobe,
/// beside means over frames of a technique without a filter.
struct RoughFloor {
    float roughness;
    CameraPose pose;
    glm::uvec2 extent;

    /// Parameters of a march that finds what is there.
    static nlohmann::json march() {
        return {{"tracer", "cells"},        {"cells.interval", true},       {"cells.max_steps", 16384},
                {"cells.edge_fade", false}, {"cells.distance_fade", false}, {"cells.back_faces", "reject"},
                {"cells.grazing_fade", 0},  {"cells.max_distance", 0},      {"cells.clip_to_near_plane", true},
                {"cells.sky_depth", 0}};
    }

    SyntheticScene scene() const {
        return [roughness = roughness](const CameraRay& ray) {
            SyntheticHit hit = mirror_floor(ray);
            if (hit.metalness > 0) hit.roughness = roughness;
            return hit;
        };
    }
    bool is_floor(unsigned x, unsigned y) const {
        return mirror_floor(camera_ray(pose, extent, glm::vec2(x, y) + 0.5f)).metalness > 0;
    }

    /// Of the pixels of one row, where the floor reflects the foot of the wall and what lies above the screen.
    struct Mean {
        double shown, confidence;                ///< radiance * confidence
        double error = 0, confidence_error = 0;  ///< standard errors over the frames
    };
    unsigned row() const { return extent.y * 3 / 4; }
    std::vector<unsigned> columns() const {
        std::vector<unsigned> all;
        for (unsigned i = 0; i < 9; ++i) all.push_back(extent.x * (8 + 2 * i) / 32);
        return all;
    }

    /// Over directions of the lobe of visible normals that are above the floor.
    Mean of_lobe() const {
        Mean mean{};
        for (const unsigned x : columns()) {
            const Local local = local_at(x);
            const auto over_lobe = [&](const auto& g) {
                return mean_over_lobe(local.lobe(lobe_of_visible_normals, roughness), [&](glm::dvec3 i) {
                    return i.z <= 0 ? 0.0 : g(seen(local.point, local.world * i));
                });
            };
            const double above = over_lobe([](double) { return 1.0; });
            mean.shown += over_lobe([](double radiance) { return radiance; }) / above / double(columns().size());
            mean.confidence +=
                over_lobe([](double radiance) { return double(radiance > 0); }) / above / double(columns().size());
        }
        return mean;
    }

    /// The expectation of a ratio of `rays` rays, of which a share of `bias` is mirrored about normals of the
    /// distribution and the others go anywhere above, weighed by the density of visible normals over that of the
    /// mixture: by `count` draws in double precision, with their standard error.
    Mean of_mixture(double bias, unsigned rays, unsigned count) const {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> uniform(0, 1);
        std::vector<double> values;
        for (const unsigned x : columns()) {
            const Local local = local_at(x);
            const LobeCase visible = local.lobe(lobe_of_visible_normals, roughness),
                           all = local.lobe(lobe_of_normals, roughness);
            const glm::dvec3 o = all.o();
            const auto draw = [&]() -> glm::dvec3 {
                const double u = uniform(random), turn = 2 * M_PI * uniform(random);
                if (uniform(random) >= bias)
                    return {std::sqrt(1 - u * u) * std::cos(turn), std::sqrt(1 - u * u) * std::sin(turn), u};
                const double tangent = all.alpha() * std::sqrt(u / (1 - u));
                const glm::dvec3 m = glm::normalize(glm::dvec3(tangent * std::cos(turn), tangent * std::sin(turn), 1));
                return 2 * glm::dot(o, m) * m - o;
            };
            const auto density = [&](const LobeCase& lobe, glm::dvec3 i) {
                glm::dvec3 m = glm::normalize(o + i);
                if (m.z < 0) m = -m;
                return lobe_normal_density(lobe, m) / (4 * std::abs(glm::dot(o, m)));
            };
            for (unsigned k = 0; k < count; ++k) {
                double sum = 0, weights = 0;
                for (unsigned ray = 0; ray < rays; ++ray) {
                    const glm::dvec3 i = draw();
                    if (i.z <= 0) continue;
                    const double weight = density(visible, i) / ((1 - bias) / (2 * M_PI) + bias * density(all, i));
                    sum += weight * seen(local.point, local.world * i), weights += weight;
                }
                values.push_back(weights > 0 ? sum / weights : 0);
            }
        }
        Mean mean{};
        mean.shown = average(values, mean.error);
        return mean;
    }

    /// Of `count` frames of radiance and confidence (4 channels).
    template <class Render>
    Mean mean(const Render& render, unsigned count) const {
        std::vector<double> shown, confidence;
        for (unsigned frame = 0; frame < count; ++frame) {
            const HostImage image = render(frame);
            double sum = 0, share = 0;
            for (const unsigned x : columns()) {
                const float* p = image.pixel(x, row());
                sum += double(p[0]) * p[3], share += p[3];
            }
            shown.push_back(sum / double(columns().size()));
            confidence.push_back(share / double(columns().size()));
        }
        Mean mean{};
        mean.shown = average(shown, mean.error), mean.confidence = average(confidence, mean.confidence_error);
        return mean;
    }

private:
    /// A pixel's floor: the frame of its lobe has the viewer in the plane of x and z, z up.
    struct Local {
        glm::dvec3 point;
        glm::dmat3 world;  ///< from that frame
        float view_degrees;

        LobeCase lobe(unsigned kind, float roughness) const {
            return {.lobe = kind, .roughness = roughness, .view_degrees = view_degrees, .bias = 0};
        }
    };
    Local local_at(unsigned x) const {
        const CameraRay ray = camera_ray(pose, extent, glm::vec2(x, row()) + 0.5f);
        const glm::dvec3 up(0, 1, 0), to_viewer = -glm::dvec3(ray.direction);
        const glm::dvec3 sideways = glm::normalize(to_viewer - glm::dot(to_viewer, up) * up);
        return {.point = glm::dvec3(mirror_floor(ray).distance * ray.direction),
                .world = {sideways, glm::cross(up, sideways), up},
                .view_degrees = float(glm::degrees(std::acos(glm::dot(to_viewer, up))))};
    }
    /// Radiance of the wall where a ray meets it within the image; 0: it does not.
    double seen(glm::dvec3 from, glm::dvec3 direction) const {
        if (direction.z >= 0) return 0;
        const glm::dvec3 hit = from + (-6 - from.z) / direction.z * direction;
        const double half_height = std::tan(0.5 * pose.vertical_fov) * 6,
                     half_width = half_height * extent.x / extent.y;
        if (std::abs(hit.y) >= half_height || std::abs(hit.x) >= half_width) return 0;
        return hit.y > 1 ? 1 : 0.25;
    }
    static double average(const std::vector<double>& values, double& error) {
        double sum = 0, squares = 0;
        for (const double v : values) sum += v;
        const double n = double(values.size()), mean = sum / n;
        for (const double v : values) squares += (v - mean) * (v - mean);
        error = std::sqrt(squares / (n - 1) / n);
        return mean;
    }
};
