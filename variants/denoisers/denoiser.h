#pragma once
#include "variants/common/screen_probe/screen_probe.h"
#include "variants/passes/declared_passes.h"

/// The results of rays. Ray k of a traced pixel has index (y * width + x) * max_rays + k (ray.glsl). Values have 32
/// bits: densities overflow halves below a roughness of 0.033.
struct TracedRays {
    Buffer directions;  ///< vec4: xyz view space, unit, w 1 / density of the direction (sr); w = 0: no ray
    Buffer hits;        ///< uvec4: x pixel (x | y << 16) or a marker of ray.glsl; y, z bits of: length (m), confidence
};

/// What a technique's rays hand to a denoiser. Shaders that read rays (seen.glsl, ray.glsl) run with the technique's
/// parameters, which include those of rays.json.
struct DenoisedRays {
    const ParameterSet& technique;
    TracedRays traced;
    Image color;  ///< the lit image that hits show: this frame's, or with `previous_frame` the last frame's
    std::optional<ScreenProbe> probe;  ///< if `misses` is probe
};

/// A denoiser as the file denoiser.json of a folder of variants/denoisers declares it: its page of the catalogue, its
/// parameters and its passes. What these find besides their own images and those of ProvidedImages:
///     hit_color               the lit image that hits show
///     own_radiance            rgba32f: rgb mean of what a pixel's own rays see, weighed by the lobe of visible normals
///                             over the density with which they were drawn; a share of it that is known
///     own_length              r32f: mean length of those that hit (m); 0: none
///     ray_radiance            rgba32f, of one ray of each pixel, another one every frame; black where there is none:
///                             rgb what it sees times the share of it that is known, a that share
///     ray_direction           rgba32f: xyz direction times length (m, world space; of a miss the far plane's
///                             distance), w density with which it came about, as if none of the lobe were cut off
///                             (sr^-1)
///     screen_probe            where `misses` is probe, the images of common/screen_probe/lookup.glsl; else others,
///     screen_probe_nearness   which nothing reads
/// and the buffers `directions` and `hits` (TracedRays) and `seen_rays`: what each ray sees, of seen_rays.glsl.
struct DenoiserEntry {
    std::string name, title, source, description;
    bool needs_density = true;            ///< weighs neighbours' rays by densities, which mirror rays do not have
    bool takes_probe = true;              ///< sees misses by seen.glsl, which reads the probe
    bool answers_rough_surfaces = false;  ///< also reflects on surfaces rougher than max_roughness
    std::shared_ptr<const Declaration>
        passes;                          ///< its parameters are those that users see, without the denoiser's name
    std::vector<Parameter> given;        ///< further parameters of its shaders, which the technique decides ...
    bool is_given_as_technique = false;  ///< ... by its own parameters of these names ...
    nlohmann::json given_values = nlohmann::json::object();  ///< ... and by these values, or names of given_facts()
    std::vector<std::string> sources;                        ///< shaders, by their paths from the root
    std::string content_hash;                                ///< of its declaration
};

/// Reads variants/denoisers/<name>/denoiser.json. Fails with Error, which names the place, if something is wrong.
DenoiserEntry read_denoiser(const std::string& name);

/// Facts of a technique's rays that a denoiser may get, by name:
/// - `rays.NAME`: the parameters of rays.json, but `rays.misses` is fallback if misses see anything
/// - `rays.has_probe`
/// - `rays.excluded_alpha`: the least squared roughness above that of the roughest traced surface
nlohmann::json given_facts(const ParameterSet& technique);

/// The passes of one denoiser and its data between frames. `params` holds all parameters that its shaders name.
class Denoiser {
public:
    explicit Denoiser(const DenoiserEntry& entry);

    /// Takes the values that the technique decides. Call it before all other functions.
    void decide(const ParameterSet& technique);
    /// Adds this frame's passes. Passes that read rays come first, with the technique's parameters; then the
    /// pass_list's parameters are `params`.
    Reflections run(PassList& pass_list, const GBuffer& gbuffer, const DenoisedRays& rays);
    /// The stages of its passes, in order.
    std::vector<std::string> stages() const;
    bool draws_random_numbers() const;
    std::string not_repeatable() const;  ///< as of Technique::not_repeatable()
    /// Stages whose shaders look at a constant of a scene (core/gpu/pipelines/shader.h).
    std::vector<std::string> readers_of(const std::string& scene_constant) const;
    /// The stage that reads what rays see, before the denoiser's passes; "" if its own passes do so.
    std::string stage_of_rays() const;

    const DenoiserEntry& entry;
    ParameterSet params;

private:
    KnownValues known() const { return entry.passes->known_values(params); }
    bool has_read(const std::string& image_or_buffer) const;

    ProvidedImages provided_;
};
