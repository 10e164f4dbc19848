#pragma once
#include "groundtruth/paths/path_tracer.h"
#include "groundtruth/reference/reference_pixel.h"  // batch_count

#include <array>
#include <vector>

/// A scene built in code, in world space: each shape is a mesh and an instance of its own.
struct TestScene {
    Scene scene;

    TestScene();
    unsigned add(const Material& material);
    /// Corners counter-clockwise as seen from the front.
    void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, unsigned material);
    /// A latitude-longitude sphere of 2 n x n quads; its front is the outside, or the inside.
    void sphere(glm::vec3 center, float radius, int n, unsigned material, bool is_inward = false);
    /// An axis-parallel box whose front is the inside.
    void room(glm::vec3 min, glm::vec3 max, unsigned material);
    void mesh(Mesh mesh, const glm::mat4& world_from_object = glm::mat4(1.0f));

    ScenePose pose() const;

private:
    std::vector<glm::mat4> transforms_;
};

Material lambert_material(float albedo, float emission = 0.0f);
/// A metal of F0 = `f0` and F90 = 1.
Material metal_material(float f0, float roughness);

/// An orthographic camera at `eye` that looks along `direction`; a single pixel sees the point ahead of it.
CameraPose looking_along(glm::vec3 eye, glm::vec3 direction);

/// An orthographic camera 1 m from the origin that sees it under the angle whose cosine to `normal` is `cosine`; the
/// viewer's side is `towards`, a unit vector perpendicular to `normal`.
CameraPose looking_at_origin(glm::vec3 normal, glm::vec3 towards, float cosine);

struct Moments {
    glm::dvec3 mean{0.0}, standard_error{0.0};
};
struct PixelMoments {
    FirstHit hit;
    Moments diffuse, specular, incident;  ///< `diffuse` includes emission
    Moments camera_radiance, on_screen;   ///< with PathTracerSettings::ladder
    double on_screen_share = 0;
    double cut = 0;  ///< PixelEstimate::cut / samples, mean over RGB
    uint64_t non_finite = 0;
};

/// Renders one pixel with 16 independent batches; the standard error comes from their spread, so that it follows
/// Student's t distribution with 15 degrees of freedom.
PixelMoments render_pixel(const PathTracer& tracer, unsigned x, unsigned y, unsigned samples_per_batch,
                          uint64_t seed = 1, Directions directions = {});

/// The one pixel of a camera.
PixelMoments render(const TestScene& scene, const CameraPose& camera, unsigned samples_per_batch,
                    PathTracerSettings settings = {}, uint64_t seed = 1);

/// Irradiance / radiance at `point` with unit `normal` from a polygon wholly above its horizon (Lambert 1760): the mean
/// over its edges of angle times the normal's cosine to the edge's plane. Its area counts as seen from the side that
/// sees it counter-clockwise.
double polygon_form_factor(glm::dvec3 point, glm::dvec3 normal, const std::vector<glm::dvec3>& corners);

/// Sum over the front-facing triangles of the scene's mesh `index`.
double mesh_form_factor(const TestScene& scene, size_t index, glm::dvec3 point, glm::dvec3 normal);
