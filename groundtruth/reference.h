#pragma once
#include "core/host_image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <functional>
#include <string>

/// One quantity of every pixel, from two independent halves of the samples: the mean is (half_a + half_b) / 2.
struct ReferenceOutput {
    HostImage mean;      ///< RGB
    HostImage half_a, half_b;
    HostImage variance;  ///< of `mean`, per channel
};

/// What the path tracer knows of one frame of one camera. Pixel centres and first hits are those of the G-buffer.
struct Reference {
    glm::uvec2 extent{0, 0};
    ReferenceOutput image;     ///< full path-traced radiance
    ReferenceOutput diffuse;   ///< emission of the first hit (or the environment, where nothing is hit) and its diffuse reflection: the lit colour
    ReferenceOutput specular;  ///< specular reflection of the first hit; image = diffuse + specular
    ReferenceOutput incident;  ///< incident radiance averaged over the visible-normal lobe, weight 1: what a variant estimates
    HostImage sample_count;    ///< one channel
    HostImage depth;           ///< one channel: distance along -z (m), 0 where nothing was hit
    HostImage geometric_normal, normal;  ///< XYZ, world space, as in the G-buffer
    HostImage material_id;     ///< one channel: material index + 1, 0: background
    double seconds = 0;        ///< render time, over all continued runs
    double rays = 0;
    uint64_t non_finite_samples = 0;
    std::string hash;          ///< the key of the cache
};

struct ReferenceSettings {
    unsigned max_samples = 256;    ///< per pixel, at most
    double max_seconds = 0;        ///< 0: unlimited
    float target_relative_error = 0;  ///< relative standard error of the specular output at each pixel; 0: no such stop
    unsigned max_depth = 64;       ///< path segments
    unsigned seed = 0x5eed;
};

/// Called now and then: fraction done in [0, 1], rays per second, seconds left.
using ReferenceProgress = std::function<void(double fraction, double rays_per_second, double seconds_left)>;
