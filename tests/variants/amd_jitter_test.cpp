// What AMD's technique draws at random: normals or rays.
#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/technique_fixture.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace {

struct AmdJitter : TechniqueTest {
    static constexpr float roughness = 0.4f;
    FrameView view{.extent = {128, 128}};
    CameraPose pose{.is_orthographic = true, .orthographic_height = 2};

    /// Directions of the rays of four frames of a plane that is seen at this angle (degrees).
    std::vector<glm::dvec3> rays(float incidence, const char* jitter) {
        const float angle = glm::radians(incidence);
        const auto plane = [=](const CameraRay&) {
            return SyntheticHit{.distance = 5,
                                .normal = {std::sin(angle), 0, std::cos(angle)},
                                .roughness = roughness,
                                .metalness = 1,
                                .specular = 1};
        };
        const auto technique = make_technique("amd_sssr", {{"jitter", jitter},
                                                           {"samples_per_quad", 4},
                                                           {"noise", "white"},
                                                           {"denoise", false},
                                                           {"float_roughness", true}});
        RayProbe probe;
        probe.is_recording = true;
        technique->ray_probe = &probe;
        PassList pass_list(device(), view.extent);
        std::vector<glm::dvec3> directions;
        for (view.frame = 0; view.frame < 4; ++view.frame) {
            const CameraData camera = camera_data(pose, view.frame > 0 ? &pose : nullptr, view);
            const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, plane);
            pass_list.begin_frame(camera, technique->params, gbuffer.images());
            technique->render(pass_list, gbuffer);
            for (const RayRecord& ray : probe.recorded.at(0).rays)
                if (ray.is_traced > 0) directions.push_back(ray.direction);
            probe.recorded.clear();
        }
        return directions;
    }
};

/// Uniform in share and azimuth about the axis: chi-square over 8x8 bins; 114 is the 0.9999 quantile of 63 degrees of
/// freedom. `tan2`: of the half angle between axis and ray, the angle of the normal that a view along the axis draws.
double chi_square(const std::vector<glm::dvec3>& rays, glm::dvec3 axis) {
    const double alpha = AmdJitter::roughness * AmdJitter::roughness;
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), axis)), y = glm::cross(axis, x);
    std::array<double, 64> counts{};
    for (const glm::dvec3& ray : rays) {
        const double cosine = glm::dot(ray, axis), tan2 = (1 - cosine) / (1 + cosine);
        const double share = tan2 / (alpha * alpha + tan2);
        const double turn = std::atan2(glm::dot(ray, y), glm::dot(ray, x)) / (2 * glm::pi<double>()) + 0.5;
        counts[std::min(size_t(8 * share), size_t(7)) * 8 + std::min(size_t(8 * turn), size_t(7))] += 1;
    }
    double sum = 0;
    const double expected = double(rays.size()) / 64;
    for (const double count : counts) sum += (count - expected) * (count - expected) / expected;
    return sum;
}

TEST_F(AmdJitter, OfRaysIsRoundAboutTheMirrorDirection) {
    for (const float incidence : {0.0f, 40.0f, 75.0f}) {
        const float angle = glm::radians(2 * incidence);
        const glm::dvec3 mirror(std::sin(angle), 0, std::cos(angle));
        const std::vector<glm::dvec3> jittered = rays(incidence, "ray");
        ASSERT_GT(jittered.size(), 60000u);
        EXPECT_LT(chi_square(jittered, mirror), 114) << incidence;
        // Normals make the same lobe of a view along the normal, and no round one of any other.
        const double of_normals = chi_square(rays(incidence, "normal"), mirror);
        if (incidence == 0)
            EXPECT_LT(of_normals, 114);
        else
            EXPECT_GT(of_normals, 1000);
    }
}

}  // namespace
