#pragma once
#include "core/scene/scene.h"
#include "groundtruth/scene/embree_scene.h"

#include <span>
#include <vector>

/// The images of punctual lights in flat, smooth surfaces. Light that such a surface, a mirror, reflects to a point
/// arrives from few directions, and no ray meets a punctual light. So sampling the lobe of the point finds this light
/// rarely, with much weight. Here directions are drawn about the one to the lamp's image: the half vector that they
/// have at the mirror is distributed as GGX has it, but for the error of a linear step from the point of exact
/// reflection (as in manifold exploration, Jakob and Marschner 2012; of a plane the step has a closed form).
class MirroredLamps {
public:
    static constexpr uint32_t none = ~0u;

    MirroredLamps() = default;
    /// `lamps`: that shine. `diagonal`: of the scene (m). Takes the brightest images, 16 at most.
    MirroredLamps(const Scene& scene, const EmbreeScene& geometry, std::span<const PunctualLight> lamps,
                  float diagonal);

    /// Keeps the images of these indices, which are sorted, and numbers them anew.
    void keep(std::span<const uint32_t> images);

    uint32_t count() const { return uint32_t(images_.size()); }
    uint32_t lamp(uint32_t image) const { return images_[image].lamp; }  ///< index of `lamps`
    /// The mirror of a triangle, or none.
    uint32_t mirror(uint32_t instance, uint32_t triangle) const {
        return mirrors_of_[instance].empty() ? none : mirrors_of_[instance][triangle];
    }
    uint32_t mirror_of(uint32_t image) const { return images_[image].mirror; }
    /// The image of a lamp in a mirror, or none.
    uint32_t image(uint32_t mirror, uint32_t lamp) const { return image_of_[mirror * lamp_count_ + lamp]; }

    struct Sample {
        glm::vec3 direction;  ///< unit, towards the mirror
        float pdf;            ///< sr^-1; 0: the lamp or the point is behind the mirror
        float radiance;       ///< about the luminance that arrives, if nothing hides it (W sr^-1 m^-2)
    };
    /// A direction from `point` (m). `u`: uniform in [0, 1)^2.
    Sample sample(uint32_t image, glm::vec3 point, glm::vec2 u) const;
    /// Density (sr^-1) with which sample() draws a direction.
    float pdf(uint32_t image, glm::vec3 point, glm::vec3 direction) const;

private:
    struct Mirror {
        glm::vec3 normal;  ///< unit, of the front
        float offset;      ///< m: dot(normal, point) of its points
        float alpha, reflectance;
    };
    struct Image {
        uint32_t mirror, lamp;
    };
    struct Reflection;
    struct Found;
    static std::vector<Found> find_mirrors(const Scene& scene, const EmbreeScene& geometry, float diagonal);
    bool reflect(uint32_t image, glm::vec3 point, Reflection& reflection) const;

    std::vector<PunctualLight> lamps_;
    uint32_t lamp_count_ = 0;
    std::vector<Mirror> mirrors_;
    std::vector<std::vector<uint32_t>> mirrors_of_;  ///< of each triangle of each instance; empty: none
    std::vector<Image> images_;
    std::vector<uint32_t> image_of_;  ///< of each mirror and lamp
};
