#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "core/gbuffer/split_sum_image.h"
#include "core/variant.h"

/// What a technique's result makes of the image.
struct Composite {
    Image specular;  ///< rgba32f: (F0 A + F90 B) mix(fallback, radiance, confidence); 0 in the background
    Image image;     ///< rgba32f: lit + specular
};

/// The one compositor for all variants (design: the factorisation of Karis 2013, with the split-sum integral of our
/// BRDF).
class Compositor {
public:
    explicit Compositor(PassGraph& graph) : graph_(graph) {}  ///< `graph` must outlive it

    /// A pass of the graph's current frame.
    Composite render(const GBuffer& gbuffer, const Reflections& reflections);

private:
    PassGraph& graph_;
    SplitSumImage split_sum_;
};

/// F0 A + F90 B of every pixel, RGB; 0 in the background, for unlit materials, and where the shading normal faces away.
HostImage specular_reflectance(const HostGBuffer& gbuffer);

/// The formula of Compositor on the CPU. `radiance` has 3 channels or more, `confidence` 1 or more. RGB.
struct HostComposite {
    HostImage specular, image;
};
HostComposite composite(const HostGBuffer& gbuffer, const HostImage& radiance, const HostImage& confidence);
