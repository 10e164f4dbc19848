#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/gbuffer_file.h"
#include "core/gbuffer/reflections.h"
#include "core/gbuffer/split_sum_image.h"
#include "core/gpu/passes/pass_list.h"

/// How a technique's reflections are joined with the environment's.
enum class CompositeFormula {
    split_sum,         ///< (F0 A + F90 B) mix(fallback, radiance, confidence): counts nothing twice
    additive_fresnel,  ///< (F0 A + F90 B) fallback + additive_weight(confidence) radiance (core/shared/brdf.h): as an
                       ///< engine adds reflections to an image that already holds the environment's
};

/// The image with a technique's result.
struct Composite {
    Image specular;  ///< rgba32f: specular radiance by CompositeFormula; 0 in the background
    Image image;     ///< rgba32f: `lit` without its own reflections, plus `specular`
};

/// The one compositor for all techniques: the factorisation of Karis 2013, with the split-sum integral of ssrlab's
/// BRDF.
class Compositor {
public:
    /// `pass_list` must outlive it.
    explicit Compositor(PassList& pass_list, CompositeFormula formula = CompositeFormula::split_sum)
        : pass_list_(pass_list), formula_(formula) {}

    /// Adds a pass to the pass_list's current frame.
    Composite render(const GBuffer& gbuffer, const Reflections& reflections);

    /// Adds the environment's specular reflection, (F0 A + F90 B) fallback, to `lit`, as in the image that an engine's
    /// SSR reads. Surfaces that rays hit then show their environment; composites still use `lit` without it. Adds
    /// passes to the pass_list's current frame and waits for them.
    void add_environment(GBuffer& gbuffer);

private:
    PassList& pass_list_;
    CompositeFormula formula_;
    SplitSumImage split_sum_;
};

/// F0 A + F90 B of every pixel, RGB; 0 in the background, for unlit materials, and where the shading normal faces away.
HostImage specular_reflectance(const HostGBuffer& gbuffer);
