#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/gbuffer_file.h"
#include "core/gbuffer/reflections.h"
#include "core/gbuffer/split_sum_image.h"
#include "core/gpu/passes/pass_list.h"

/// How reflections are put together with the environment's.
enum class CompositeFormula {
    split_sum,         ///< (F0 A + F90 B) mix(fallback, radiance, confidence): ours, in which nothing counts twice
    additive_fresnel,  ///< (F0 A + F90 B) fallback + additive_weight(confidence) radiance (core/shared/brdf.h): as an
                       ///< engine adds them to an image that holds its environment's already
};

/// What a technique's result makes of the image.
struct Composite {
    Image specular;  ///< rgba32f: by the formula; 0 in the background
    Image image;     ///< rgba32f: lit, without reflections of its own, + specular
};

/// The one compositor for all techniques (design: the factorisation of Karis 2013, with the split-sum integral of our
/// BRDF).
class Compositor {
public:
    /// `pass_list` must outlive it.
    explicit Compositor(PassList& pass_list, CompositeFormula formula = CompositeFormula::split_sum)
        : pass_list_(pass_list), formula_(formula) {}

    /// A pass of the pass_list's current frame.
    Composite render(const GBuffer& gbuffer, const Reflections& reflections);

    /// Adds to `lit` the environment's specular reflection, (F0 A + F90 B) fallback, as engines have it in the image
    /// that SSR reads: what rays hit then shows its environment. Composites go on to use `lit` as it was. Passes of the
    /// pass_list's current frame, waited for.
    void add_environment(GBuffer& gbuffer);

private:
    PassList& pass_list_;
    CompositeFormula formula_;
    SplitSumImage split_sum_;
};

/// F0 A + F90 B of every pixel, RGB; 0 in the background, for unlit materials, and where the shading normal faces away.
HostImage specular_reflectance(const HostGBuffer& gbuffer);
