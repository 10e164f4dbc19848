#pragma once
#include "variants/common/screen_probe/screen_probe.h"
#include "variants/passes/declared_passes.h"

/// What rays found, by index of the ray: (y * width + x) * max_rays + k for ray k of a traced pixel (ray.glsl). In 32
/// bits: densities overflow halves below a roughness of 0.033.
struct TracedRays {
    Buffer directions;  ///< vec4: xyz view space, unit, w 1 / density of the direction (sr); w = 0: no ray
    Buffer hits;        ///< uvec4: x pixel (x | y << 16) or a marker of ray.glsl; y, z bits of: length (m), confidence
};

/// What a technique's draw and march hand to a denoiser. Shaders that read rays (seen.glsl, ray.glsl) run with the
/// technique's parameters, of which there are those of rays.json.
struct DenoisedRays {
    const ParameterSet& technique;
    TracedRays traced;
    Image color;  ///< the lit image that hits show: of this frame, or with `previous_frame` of the last one
    std::optional<ScreenProbe> probe;  ///< where `misses` is probe
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
    bool needs_density = true;                  ///< weighs neighbours' rays by densities, which mirror rays lack
    bool takes_probe = true;                    ///< sees misses as seen.glsl does, which knows the probe
    bool answers_rough_surfaces = false;        ///< shows something on surfaces rougher than max_roughness, too
    std::shared_ptr<const Declaration> passes;  ///< with the parameters that users see, without the denoiser's name
    std::vector<Parameter> given;        ///< those that its shaders name, too, and that the technique decides: ...
    bool is_given_as_technique = false;  ///< ... by its own values of their names ...
    nlohmann::json given_values = nlohmann::json::object();  ///< ... and by values, or names of given_facts()
    std::vector<std::string> sources;                        ///< shaders, by their paths from the root
    std::string content_hash;                                ///< of what declares it
};

/// Reads variants/denoisers/<name>/denoiser.json. Fails with Error, which names the place, on what is wrong in it.
DenoiserEntry read_denoiser(const std::string& name);

/// What denoisers may be given of a technique's rays, by name: `rays.max_roughness` and all other parameters of
/// rays.json, but for `rays.misses`, which is fallback where misses see anything; `rays.has_probe`; and
/// `rays.excluded_alpha`, the least squared roughness above that of the roughest surface that is traced.
nlohmann::json given_facts(const ParameterSet& technique);

/// The passes of one denoiser, and what outlives a frame. In `params` are all parameters that its shaders name.
class Denoiser {
public:
    explicit Denoiser(const DenoiserEntry& entry);

    /// Takes what the technique decides; before all that follows.
    void decide(const ParameterSet& technique);
    /// Adds this frame's passes. Those that read rays come first, with the technique's parameters; from then on the
    /// pass_list's are `params`.
    Reflections run(PassList& pass_list, const GBuffer& gbuffer, const DenoisedRays& rays);
    /// Of its passes, in their order.
    std::vector<std::string> stages() const;
    bool draws_random_numbers() const;
    std::string not_repeatable() const;  ///< as of Technique::not_repeatable()
    /// Stages whose shaders look at a constant of a scene (core/gpu/pipelines/shader.h).
    std::vector<std::string> readers_of(const std::string& scene_constant) const;
    /// The one that reads what rays see, before the denoiser's own; "" where its own passes do.
    std::string stage_of_rays() const;

    const DenoiserEntry& entry;
    ParameterSet params;

private:
    KnownValues known() const { return entry.passes->known_values(params); }
    bool has_read(const std::string& image_or_buffer) const;

    ProvidedImages provided_;
};
