#include "groundtruth/lights/mirrored_lamps.h"

#include "core/shared/brdf.h"
#include "groundtruth/sampling/lobes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace {

/// Rougher surfaces are no mirrors: sampling lobes finds what they reflect. In `sponza` with a floor of 0.25, lit by
/// the sun alone, images take more time than noise.
constexpr float most_roughness = 0.2f;
/// In `street:10004`, 16, 32 and 64 images leave 0.29, 0.38 and 0.31 of the variance: no difference beyond noise.
constexpr size_t most_images = 16;

/// Triangles of one material are one mirror where their normals and planes fall into the same cell of this size; of
/// planes, relative to the scene's diagonal. Where they do not, a surface becomes several mirrors. A normal may so be
/// off by the slope of the narrowest lobes, which costs variance alone.
constexpr float normal_cell = 1.0f / 512, offset_cell = 1e-4f;

/// What is promised must not be zero where something may arrive.
constexpr float least_fresnel = 1e-3f;

using PlaneCell = std::array<int64_t, 5>;  // material, normal, offset

bool is_smooth(const Material& material) {
    return !material.is_unlit && material.roughness <= most_roughness && material.normal_texture.texture < 0 &&
           material.metalness_roughness_texture.texture < 0 && (material.specular > 0 || material.metalness > 0);
}

/// Density of the slopes of GGX's normals (Heitz 2014, "Understanding the Masking-Shadowing Function", section 5.3).
float slope_density(float square_slope, float alpha) {
    const float spread = 1.0f + square_slope / (alpha * alpha);
    return 1.0f / (pi * alpha * alpha * spread * spread);
}

float reflectance(const Material& material) {
    const float dielectric = material.dielectric_f0 * material.specular;
    return dielectric + (luminance(material.base_color) - dielectric) * material.metalness;
}

}  // namespace

/// A mirror while its triangles are collected.
struct MirroredLamps::Found {
    Mirror mirror{};
    double area = 0;
    bool is_double_sided = false;
    glm::dvec3 center{0.0}, normal{0.0};             ///< sums over the area
    std::vector<std::array<uint32_t, 2>> triangles;  ///< instance and triangle

    /// Of the image of a lamp: the power that the mirror reflects, over the solid angle that it goes to.
    double worth(const PunctualLight& lamp) const;
};

double MirroredLamps::Found::worth(const PunctualLight& lamp) const {
    const bool has_place = lamp.type != LightType::directional;
    const glm::dvec3 to_lamp = has_place ? glm::dvec3(lamp.position) - center : -glm::dvec3(lamp.direction);
    const double height = glm::dot(normal, to_lamp),
                 before = is_double_sided ? std::abs(height) : std::max(height, 0.0);
    const double solid_angle = area * before / std::pow(glm::length(to_lamp), 3);
    const double received = has_place ? std::min(2 * M_PI, solid_angle) : area * before;
    return received * double(luminance(lamp.intensity) * mirror.reflectance / (mirror.alpha * mirror.alpha));
}

/// The exact reflection of a lamp at a mirror, as a point sees it.
struct MirroredLamps::Reflection {
    glm::vec3 at;              ///< on the mirror (m)
    glm::vec3 normal;          ///< of the mirror, on the side of the point
    glm::vec3 along, across;   ///< unit, in the mirror: along the plane of incidence, and across
    float height;              ///< of the point above the mirror (m)
    glm::vec2 slope_per_step;  ///< of the half vector, along and across (m^-1)
    float cosine;              ///< of the angle of incidence
};

std::vector<MirroredLamps::Found> MirroredLamps::find_mirrors(const Scene& scene, const EmbreeScene& geometry,
                                                              float diagonal) {
    std::map<PlaneCell, Found> found;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceRecord& instance = geometry.instance(i);
        const Material& material = scene.materials[instance.material];
        if (!is_smooth(material)) continue;
        for (uint32_t t = 0; t < instance.mesh->indices.size() / 3; ++t) {
            glm::vec3 corner[3];
            for (int k = 0; k < 3; ++k) corner[k] = geometry.point(i, t, float(k == 1), float(k == 2)).position;
            const glm::vec3 cross = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
            const double area = 0.5 * double(glm::length(cross));
            const glm::vec3 normal = geometry.point(i, t, 0, 0).front_normal;
            bool is_flat = area > 0;
            for (int k = 0; k < 3; ++k) {
                const glm::vec3 shading = geometry.point(i, t, float(k == 1), float(k == 2)).normal;
                is_flat = is_flat && glm::length(unit_normal(shading, normal) - normal) < normal_cell;
            }
            if (!is_flat) continue;
            const glm::dvec3 center = glm::dvec3(corner[0] + corner[1] + corner[2]) / 3.0;
            const auto cell = [](double value, double size) { return int64_t(std::floor(value / size + 0.5)); };
            Found& mirror = found[{int64_t(instance.material), cell(normal.x, normal_cell), cell(normal.y, normal_cell),
                                   cell(normal.z, normal_cell),
                                   cell(glm::dot(glm::dvec3(normal), center), double(offset_cell * diagonal))}];
            mirror.mirror.alpha = ggx_alpha(material.roughness);
            mirror.mirror.reflectance = reflectance(material);
            mirror.is_double_sided = material.is_double_sided;
            mirror.area += area;
            mirror.center += area * center;
            mirror.normal += area * glm::dvec3(normal);
            mirror.triangles.push_back({i, t});
        }
    }
    std::vector<Found> mirrors;
    for (auto& [cell, mirror] : found) {
        mirror.center /= mirror.area;
        mirror.normal = glm::normalize(mirror.normal);
        mirror.mirror.normal = glm::vec3(mirror.normal);
        mirror.mirror.offset = float(glm::dot(mirror.normal, mirror.center));
        mirrors.push_back(std::move(mirror));
    }
    return mirrors;
}

MirroredLamps::MirroredLamps(const Scene& scene, const EmbreeScene& geometry, std::span<const PunctualLight> lamps,
                             float diagonal)
    : lamps_(lamps.begin(), lamps.end()), lamp_count_(uint32_t(lamps.size())), mirrors_of_(scene.instances.size()) {
    if (lamps.empty() || !(diagonal > 0)) return;
    const std::vector<Found> found = find_mirrors(scene, geometry, diagonal);

    struct Candidate {
        double worth;
        uint32_t mirror, lamp;
    };
    std::vector<Candidate> candidates;  // the best so far, since scenes may have millions
    for (uint32_t m = 0; m < found.size(); ++m)
        for (uint32_t l = 0; l < lamps.size(); ++l) {
            const double worth = found[m].worth(lamps[l]);
            if (!(worth > 0)) continue;
            const auto at = std::ranges::upper_bound(candidates, worth, std::ranges::greater{}, &Candidate::worth);
            candidates.insert(at, {worth, m, l});
            if (candidates.size() > most_images) candidates.pop_back();
        }

    std::vector<uint32_t> taken(found.size(), none);
    for (const Candidate& candidate : candidates) {
        uint32_t& mirror = taken[candidate.mirror];
        if (mirror == none) {
            mirror = uint32_t(mirrors_.size());
            mirrors_.push_back(found[candidate.mirror].mirror);
            image_of_.resize(mirrors_.size() * lamp_count_, none);
            for (const auto& [instance, triangle] : found[candidate.mirror].triangles) {
                mirrors_of_[instance].resize(geometry.instance(instance).mesh->indices.size() / 3, none);
                mirrors_of_[instance][triangle] = mirror;
            }
        }
        image_of_[mirror * lamp_count_ + candidate.lamp] = count();
        images_.push_back({mirror, candidate.lamp});
    }
}

void MirroredLamps::keep(std::span<const uint32_t> images) {
    std::vector<Image> kept;
    std::ranges::fill(image_of_, none);
    for (const uint32_t i : images) {
        image_of_[images_[i].mirror * lamp_count_ + images_[i].lamp] = uint32_t(kept.size());
        kept.push_back(images_[i]);
    }
    images_ = std::move(kept);
}

/// False where the lamp or the point is behind the mirror.
bool MirroredLamps::reflect(uint32_t image, glm::vec3 point, Reflection& reflection) const {
    const Mirror& mirror = mirrors_[images_[image].mirror];
    const PunctualLight& lamp = lamps_[images_[image].lamp];
    const float signed_height = glm::dot(mirror.normal, point) - mirror.offset;
    const float side = signed_height < 0.0f ? -1.0f : 1.0f, height = std::fabs(signed_height);
    const glm::vec3 normal = side * mirror.normal;
    glm::vec3 towards;  // the lamp's image
    float steps_per_slope;
    if (lamp.type == LightType::directional) {
        const float cosine = -glm::dot(normal, lamp.direction);
        if (!(cosine > 0.0f)) return false;
        towards = -lamp.direction - 2.0f * cosine * normal;
        reflection.at = point + towards * (height / cosine);
        steps_per_slope = 2.0f * height;
    } else {
        const float lamp_height = side * (glm::dot(mirror.normal, lamp.position) - mirror.offset);
        if (!(lamp_height > 0.0f)) return false;
        const glm::vec3 to_image = lamp.position - 2.0f * lamp_height * normal - point;
        towards = glm::normalize(to_image);
        reflection.at = point + to_image * (height / (height + lamp_height));
        steps_per_slope = 2.0f * height * lamp_height / (height + lamp_height);
    }
    if (!(steps_per_slope > 0.0f)) return false;
    const float cosine = -glm::dot(normal, towards);
    const glm::vec3 tangent = towards + cosine * normal;
    const float length = glm::length(tangent);
    reflection.along = length > 1e-4f ? tangent / length : basis_from_normal(normal)[0];
    reflection.across = glm::cross(normal, reflection.along);
    reflection.normal = normal;
    reflection.height = height;
    reflection.slope_per_step = glm::vec2(cosine * cosine, 1.0f) / steps_per_slope;
    reflection.cosine = cosine;
    return cosine > 0.0f;
}

MirroredLamps::Sample MirroredLamps::sample(uint32_t image, glm::vec3 point, glm::vec2 u) const {
    Reflection reflection;
    if (!reflect(image, point, reflection)) return {glm::vec3(0.0f, 0.0f, 1.0f), 0.0f, 0.0f};
    const Mirror& mirror = mirrors_[images_[image].mirror];
    const float radius = mirror.alpha * std::sqrt(u.x / (1.0f - u.x)), turn = 2.0f * pi * u.y;
    const glm::vec2 step = glm::vec2(std::cos(turn), std::sin(turn)) * radius / reflection.slope_per_step;
    const glm::vec3 at = reflection.at + step.x * reflection.along + step.y * reflection.across;
    const glm::vec3 direction = glm::normalize(at - point);

    const PunctualLight& lamp = lamps_[images_[image].lamp];
    const float distance = lamp.type == LightType::directional ? 1.0f : glm::length(lamp.position - at);
    const float irradiance = luminance(lamp.intensity) / (distance * distance);
    const float fresnel =
        std::max(mirror.reflectance + (1.0f - mirror.reflectance) * schlick_weight(reflection.cosine), least_fresnel);
    const float reflected = fresnel * slope_density(radius * radius, mirror.alpha) / (4.0f * reflection.cosine);
    return {direction, pdf(image, point, direction), irradiance * reflected};
}

float MirroredLamps::pdf(uint32_t image, glm::vec3 point, glm::vec3 direction) const {
    Reflection reflection;
    if (!reflect(image, point, reflection)) return 0.0f;
    const float descent = -glm::dot(reflection.normal, direction);
    if (!(descent > 0.0f)) return 0.0f;
    const float distance = reflection.height / descent;
    const glm::vec3 step = point + direction * distance - reflection.at;
    const glm::vec2 slope =
        glm::vec2(glm::dot(step, reflection.along), glm::dot(step, reflection.across)) * reflection.slope_per_step;
    const float alpha = mirrors_[images_[image].mirror].alpha;
    const float per_area =
        slope_density(glm::dot(slope, slope), alpha) * reflection.slope_per_step.x * reflection.slope_per_step.y;
    const float density = per_area * distance * distance / descent;
    return std::isfinite(density) ? density : 0.0f;
}
