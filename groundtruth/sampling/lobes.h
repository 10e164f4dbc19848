#pragma once
#include "core/shared/brdf.h"

/// How direct light is estimated at each vertex of a path. All four have the same mean; power is the one to use, the
/// others exist so that tests can compare them (Veach and Guibas 1995, "Optimally Combining Sampling Techniques").
enum class LightStrategy { power, balance, light_only, bsdf_only };

/// `gltf` is the material model of every result. The other two have closed-form solutions in closed scenes: `lambert`
/// reflects baseColor / pi and nothing specularly, `constant_fresnel` uses F90 = F0.
enum class ReflectionModel { gltf, lambert, constant_fresnel };

/// The glTF BRDF at one point, seen from one direction: a specular and a diffuse lobe, with all that does not depend on
/// the direction of light computed once.
struct Lobes {
    vec3 diffuse_over_pi;
    vec3 f0, fresnel_rise;                 ///< F = f0 + fresnel_rise w, w = (1 - o.m)^5
    float dielectric_f0, dielectric_rise;  ///< the same for Fd, which the diffuse lobe loses
    float alpha;
    vec3 o;                      ///< towards the viewer, local frame
    float root_o, pdf_scale;     ///< smith_root(o.z); pdf = D pdf_scale
    float specular_probability;  ///< with which a path continues along the specular lobe
    bool has_diffuse, has_specular;
};

/// Both parts of f mu_i, and the densities of both lobes, for one direction of light.
struct LobeValues {
    vec3 diffuse, specular;
    float diffuse_pdf, specular_pdf;
};

const float inverse_pi = 1.0f / pi;

inline float luminance(vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

/// o.z must be > 0. Both lobes vanish for an unlit surface (base colour 0 and specular 0 are its equivalent).
inline Lobes make_lobes(vec3 base_color, float metalness, float roughness, float specular, vec3 o,
                        ReflectionModel model) {
    Lobes lobes;
    lobes.o = vec3(o.x, o.y, o.z);
    const bool is_lambert = model == ReflectionModel::lambert, has_rise = model == ReflectionModel::gltf;
    lobes.diffuse_over_pi = base_color * ((is_lambert ? 1.0f : 1.0f - metalness) * inverse_pi);
    lobes.f0 = is_lambert ? vec3(0.0f) : specular_f0(base_color, metalness, specular);
    lobes.fresnel_rise = has_rise ? vec3(specular_f90(metalness, specular)) - lobes.f0 : vec3(0.0f);
    lobes.dielectric_f0 = is_lambert ? 0.0f : 0.04f * specular;
    lobes.dielectric_rise = has_rise ? 0.96f * specular : 0.0f;
    lobes.alpha = ggx_alpha(roughness);
    lobes.root_o = smith_root(o.z, lobes.alpha);
    lobes.pdf_scale = 0.5f / (ggx_cap_bound(o.z, lobes.alpha) * o.z + lobes.root_o);

    // Reflectances at the mirror direction stand in for the albedos of the lobes: only the variance depends on them.
    const float w = schlick_weight(o.z);
    const float specular_albedo = luminance(lobes.f0 + lobes.fresnel_rise * w);
    const float diffuse_albedo =
        luminance(lobes.diffuse_over_pi) * pi * (1.0f - lobes.dielectric_f0 - lobes.dielectric_rise * w);
    const vec3 grazing = lobes.f0 + lobes.fresnel_rise;
    lobes.has_specular = grazing.x + grazing.y + grazing.z > 0.0f;
    lobes.has_diffuse = lobes.diffuse_over_pi.x + lobes.diffuse_over_pi.y + lobes.diffuse_over_pi.z > 0.0f;
    const float share = clamp(specular_albedo / (specular_albedo + diffuse_albedo), 0.1f, 0.9f);
    lobes.specular_probability = !lobes.has_specular ? 0.0f : !lobes.has_diffuse ? 1.0f : share;
    return lobes;
}

/// The same for a dielectric with any reflectances at normal incidence, at most 1, which `specular` scales. It is
/// separate from the code above, which would be rounded differently if compilers shared parts: images of other scenes
/// keep their bits.
inline Lobes make_lobes(vec3 base_color, float metalness, float roughness, float specular, vec3 dielectric_f0, vec3 o,
                        ReflectionModel model) {
    Lobes lobes = make_lobes(base_color, metalness, roughness, specular, o, model);
    const bool is_lambert = model == ReflectionModel::lambert, has_rise = model == ReflectionModel::gltf;
    const float largest = max(dielectric_f0.x, max(dielectric_f0.y, dielectric_f0.z));
    lobes.f0 = is_lambert ? vec3(0.0f) : specular_f0(base_color, metalness, specular, dielectric_f0);
    lobes.fresnel_rise = has_rise ? vec3(specular_f90(metalness, specular)) - lobes.f0 : vec3(0.0f);
    lobes.dielectric_f0 = is_lambert ? 0.0f : largest * specular;  // diffuse light lacks the most of all colours
    lobes.dielectric_rise = has_rise ? (1.0f - largest) * specular : 0.0f;
    const float w = schlick_weight(o.z), diffuse = luminance(lobes.diffuse_over_pi) * pi;
    const float specular_albedo = luminance(lobes.f0 + lobes.fresnel_rise * w);
    const float diffuse_albedo = diffuse * (1.0f - lobes.dielectric_f0 - lobes.dielectric_rise * w);
    // A white base below a reflectance of 1 has no albedo left of its own.
    const float share = clamp(specular_albedo / max(specular_albedo + diffuse_albedo, 1e-6f), 0.1f, 0.9f);
    lobes.specular_probability = !lobes.has_specular ? 0.0f : !lobes.has_diffuse ? 1.0f : share;
    return lobes;
}

/// i: towards the light, unit, local frame. All zero below the horizon. Branchless, for vector loops.
inline LobeValues evaluate(const Lobes& lobes, vec3 i) {
    const vec3 h = lobes.o + i;
    const vec3 m = h * (1.0f / sqrt(dot(h, h)));
    const float w = schlick_weight(dot(lobes.o, m));
    const float d = ggx_distribution(m, lobes.alpha);
    const float root_i = smith_root(i.z, lobes.alpha);
    const float cosine = i.z > 0.0f ? i.z : 0.0f;
    const float masked_d = i.z > 0.0f ? d : 0.0f;
    LobeValues values;
    values.diffuse = lobes.diffuse_over_pi * ((1.0f - lobes.dielectric_f0 - lobes.dielectric_rise * w) * cosine);
    values.diffuse_pdf = cosine * inverse_pi;
    values.specular =
        (lobes.f0 + lobes.fresnel_rise * w) * (masked_d * cosine * 0.5f / (lobes.o.z * root_i + cosine * lobes.root_o));
    values.specular_pdf = masked_d * lobes.pdf_scale;
    return values;
}

/// Weight of a sample drawn with density `pdf` where another technique draws it with density `other`.
class MisHeuristic {
public:
    explicit MisHeuristic(LightStrategy strategy)
        : uses_light_(strategy != LightStrategy::bsdf_only),
          uses_bsdf_(strategy != LightStrategy::light_only),
          linear_(strategy == LightStrategy::balance ? 1.0f : 0.0f),
          square_(strategy == LightStrategy::power ? 1.0f : 0.0f),
          light_scale_(uses_light_ ? 1.0f : 0.0f) {}

    /// Branchless, for vector loops. light_pdf > 0.
    float of_light(float light_pdf, float bsdf_pdf) const { return light_scale_ * combine(light_pdf, bsdf_pdf); }

    /// light_pdf is 0 where no light sample finds the point.
    float of_bsdf(float bsdf_pdf, float light_pdf) const {
        if (light_pdf == 0.0f || !uses_light_) return 1.0f;
        return uses_bsdf_ ? combine(bsdf_pdf, light_pdf) : 0.0f;
    }

private:
    float combine(float pdf, float other) const {
        const float ratio = other / pdf;
        return 1.0f / (1.0f + ratio * (linear_ + square_ * ratio));
    }

    bool uses_light_, uses_bsdf_;
    float linear_, square_;  ///< both 0 if only one technique is used
    float light_scale_;
};
