#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/prefiltered_environment.h"
#include "core/gpu/passes/pass_list.h"

/// The environment on the GPU, for passes that include core/shaders/gbuffer/environment.glsl.
class EnvironmentImages {
public:
    /// Without `prefilter` shaders can read only the sharp radiance. `environment` must outlive this.
    EnvironmentImages(PassList& pass_list, const Environment& environment, bool prefilter);

    /// Binds images and constants to the pass; `bind_sharp` for shaders that do not read the prefiltered image.
    PassList::Pass& bind(PassList::Pass& pass) const;
    PassList::Pass& bind_sharp(PassList::Pass& pass) const;
    /// As bind_sharp(), with the kind of environment compiled in.
    PassList::Pass& bind_rays(PassList::Pass& pass) const;
    static void compile_in(PassList::Pass& pass, unsigned kind);

    const PrefilteredEnvironment& prefiltered() const { return prefiltered_; }

private:
    const Environment& environment_;
    PrefilteredEnvironment prefiltered_;
    Image sharp_, atlas_;
};

/// Binds the environment for rays that hit nothing, for shaders that call
/// environment_along_ray(). A G-buffer from files knows it only as `fallback`, its mean over each pixel's lobe.
PassList::Pass& bind_environment(PassList::Pass& pass, const GBuffer& gbuffer);
