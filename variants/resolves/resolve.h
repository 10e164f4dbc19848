#pragma once
#include "variants/common/screen_probe/screen_probe.h"
#include "variants/resolves/ray_draw.h"
#include "variants/resolves/traced_rays.h"
#include "variants/variant.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// What a technique's draw and march hand to a resolve. Shaders that read rays (seen.glsl, ray.glsl) run with the
/// technique's parameters, of which there are those of ray_draw.h, `draw_directions`, `misses` (weight, fallback,
/// probe) and `previous_frame`.
struct ResolvedRays {
    TracedRays traced;
    Image color;          ///< the lit image that hits show: of this frame, or with `previous_frame` of the last one
    Image below_horizon;  ///< of FrostbiteHorizonImage: share of draws that go below the horizon
    const RayDrawParameters& draw;
    std::optional<ScreenProbe> probe;  ///< where `misses` is probe
    bool misses_are_known = false;     ///< to see the environment, or what the probe guesses
    bool previous_frame = false;
};

/// What each pixel's own rays see, weighed by the lobe of visible normals over the density with which they were drawn.
struct OwnRays {
    Image radiance;    ///< `own_radiance`, rgba32f: rgb mean of what they see, a share of it that is known
    Image ray_length;  ///< `own_length`, r32f: mean length of those that hit (m); 0: none
};
OwnRays average_own_rays(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays);

/// One ray of each pixel, another one every frame; black where there is none.
struct RayImages {
    Image radiance;   ///< `ray_radiance`, rgba32f: rgb what it sees times the share of it that is known, a that share
    Image direction;  ///< `ray_direction`, rgba32f: xyz direction times length (m, world space; of a miss the far
                      ///< plane's distance), w density with which it came about, as if none of the lobe were cut
                      ///< off (sr^-1)
};
RayImages ray_images(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays);

/// What each ray sees, for resolves whose pixels share rays: the buffer `seen_rays` of seen_rays.glsl.
Buffer see_rays(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays);

/// The images of common/screen_probe/lookup.glsl; others, which nothing reads, where there is no probe.
PassGraph::Pass& bind_probe(PassGraph::Pass& pass, const ResolvedRays& rays);

/// Which stages of a resolve read what a scene may not need.
struct StageReads {
    std::string rays;                   ///< what rays see, and so the environment and the motion of hits, if at all
    std::vector<std::string> motion;    ///< motion of the pixel's own surface
    std::vector<std::string> specular;  ///< of a pixel no more than whether it has a specular term
};

/// One way to make a picture of rays: its passes, and what outlives a frame. In `params` are all parameters that its
/// shaders name; those that the technique decides are taken from it before each frame.
class Resolve {
public:
    virtual ~Resolve() = default;

    /// Adds this frame's passes. Those that read rays come first, with the technique's parameters; use_own_params()
    /// starts the others.
    virtual Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) = 0;
    /// Of its passes, in their order.
    virtual std::vector<std::string> stages() const = 0;
    virtual bool draws_random_numbers() const { return false; }
    virtual std::string not_repeatable() const { return {}; }  ///< as of Variant::not_repeatable()
    virtual StageReads reads() const = 0;
    /// Shows something on surfaces rougher than max_roughness, too.
    virtual bool answers_rough_surfaces() const { return false; }

    ParameterSet params;

protected:
    /// From now on the graph's passes have `params`, in which `given` are set: values that the technique decides.
    void use_own_params(PassGraph& graph, const nlohmann::json& given);
};

/// A resolve's page of the catalogue.
struct ResolveEntry {
    std::string name, title, source, description;
    std::string folder;         ///< with its sources: "variants/resolves/mean/"
    bool needs_density = true;  ///< weighs neighbours' rays by densities, which mirror rays lack
    bool takes_probe = true;    ///< sees misses as seen.glsl does, which knows the probe
    /// Declares the parameters that a technique has of it, in which their names begin with the resolve's:
    /// `blur.blur_width`.
    std::function<void(ParameterSet&)> declare = [](ParameterSet&) {};
    std::vector<std::string> given = {};  ///< of those the ones that the technique decides
    std::function<std::unique_ptr<Resolve>()> create;
};
