// Frostbite's ray reuse against the path tracer: over a flat floor of one roughness all neighbours' lobes are alike,
// and the mean over seeds must be the truth's on-screen rung, if the rays are those of the whole lobe.
#include "core/gbuffer/rasterizer.h"
#include "core/gpu/device.h"
#include "groundtruth/paths/path_tracer.h"
#include "variants/registry.h"

#include <gtest/gtest.h>
#include <array>
#include <cmath>

namespace {

constexpr glm::uvec2 extent(96, 64);

Material black_emitter(glm::vec3 radiance) {
    return {.base_color = glm::vec3(0), .metalness = 0, .emission = radiance, .specular = 0};
}

void add_quad(Scene& scene, std::array<glm::vec3, 4> corners, const Material& material) {
    Mesh mesh{.indices = {0, 1, 2, 0, 2, 3}, .material = unsigned(scene.materials.size())};
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[3] - corners[0]));
    for (const glm::vec3 corner : corners)
        mesh.vertices.push_back({.position = corner, .normal = normal, .tangent = {1, 0, 0, 1}, .color = glm::vec4(1)});
    scene.materials.push_back(material);
    scene.instances.push_back({.mesh = unsigned(scene.meshes.size()), .node = 0});
    scene.meshes.push_back(mesh);
}

/// A rough metal floor before a wall of four panels, all of it on the screen, in the dark. The camera is rolled, so
/// that the wall's borders run through pixels everywhere: along a row they would all be off by the same part of a
/// pixel.
Scene floor_before_panels() {
    Scene scene{.name = "floor_before_panels"};
    scene.nodes.push_back({.name = "root"});
    add_quad(scene, {{{-8, 0, 4}, {8, 0, 4}, {8, 0, -4}, {-8, 0, -4}}},
             {.base_color = glm::vec3(0.6f), .metalness = 1, .roughness = 0.5f});
    const glm::vec3 radiance[] = {{1, 0.1f, 0.4f}, {0.1f, 1, 0.4f}, {2, 0.3f, 0.4f}, {0.5f, 2, 0.4f}};
    for (int i = 0; i < 4; ++i) {
        const float x = 1.5f * float(i - 2);
        add_quad(scene, {{{x, 0, -4}, {x + 1.5f, 0, -4}, {x + 1.5f, 2, -4}, {x, 2, -4}}}, black_emitter(radiance[i]));
    }
    scene.cameras.push_back(
        {.name = "main", .keys = {{.position = {0, 1.2f, 3}, .target = {0, 0.8f, -4}, .up = {0.2f, 1, 0}}}});
    return scene;
}

/// Means over a part of the floor, and their standard errors.
struct RegionMean {
    glm::dvec3 mean{0}, error{0};
};

RegionMean mean_of(const std::vector<glm::dvec3>& values) {
    RegionMean result;
    glm::dvec3 squares(0);
    for (const glm::dvec3& v : values) result.mean += v / double(values.size());
    for (const glm::dvec3& v : values) squares += (v - result.mean) * (v - result.mean);
    result.error = glm::sqrt(squares / double(values.size() * (values.size() - 1)));
    return result;
}

/// Nearer to the wall than 1.5 m, steps from pixel to pixel are as long as the way to it.
bool is_in_region(const FirstHit& hit) {
    return hit.is_hit && hit.material == 0 && hit.position.z > -2.5f && std::abs(hit.position.x) < 2;
}

struct FrostbiteTruth : testing::Test {
    Scene scene = floor_before_panels();
    ScenePose pose = pose_scene(scene, 0);
    PathTracer tracer{scene, pose, pose_camera(scene.cameras.front(), pose, 0), extent, {.ladder = true}};
    Device device;
    Rasterizer rasterizer{device, scene, {.extent = extent}};
    GBuffer gbuffer;
    std::vector<FirstHit> hits;

    void SetUp() override {
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) hits.push_back(tracer.first_hit(x, y));
        gbuffer = rasterizer.render(scene.cameras.front(), {.extent = extent});
        rasterizer.light_directly(gbuffer);
    }
    void TearDown() override { EXPECT_EQ(device.validation_messages(), std::vector<std::string>()); }

    glm::dvec3 region_mean(const std::function<glm::dvec3(unsigned pixel)>& value) const {
        glm::dvec3 sum(0);
        double count = 0;
        for (unsigned i = 0; i < hits.size(); ++i)
            if (is_in_region(hits[i])) sum += value(i), ++count;
        EXPECT_GT(count, 1000);
        return sum / count;
    }

    /// Of 16 independent batches: mean radiance over the lobe as far as the screen shows it, and specular radiance.
    std::array<RegionMean, 2> truth() const {
        std::vector<glm::dvec3> on_screen, specular;
        for (unsigned batch = 0; batch < 16; ++batch) {
            std::vector<PixelEstimate> estimates(hits.size());
            for (unsigned i = 0; i < hits.size(); ++i)
                if (is_in_region(hits[i]))
                    tracer.trace(i % extent.x, i / extent.x, hits[i], batch + 1, 0, 64, estimates[i]);
            on_screen.push_back(
                region_mean([&](unsigned i) { return estimates[i].on_screen / double(estimates[i].lobe_samples); }));
            specular.push_back(
                region_mean([&](unsigned i) { return estimates[i].specular / double(estimates[i].samples); }));
        }
        return {mean_of(on_screen), mean_of(specular)};
    }

    /// Over 48 seeds; times the reflectance where `is_specular`.
    RegionMean found(const nlohmann::json& changes, bool is_specular) {
        nlohmann::json parameters = {{"temporal_filter", false},
                                     {"previous_frame", false},
                                     {"filtered_sampling", false},
                                     {"classification", false},
                                     {"taps", "16"},
                                     {"reuse_jacobian", true},
                                     {"half_resolution", false},
                                     {"rough_from", 1.0},
                                     {"frostbite.relative_thickness", 0.001},
                                     {"importance_bias", 0.0},
                                     {"max_rays", 4}};
        parameters.update(changes);
        const std::unique_ptr<Technique> technique = make_technique("frostbite_sssr", parameters);
        PassList pass_list(device, extent);
        std::vector<glm::dvec3> means;
        for (unsigned seed = 0; seed < 48; ++seed) {
            CameraData camera = rasterizer.camera();
            camera.frame.y = seed;
            pass_list.begin_frame(camera, technique->params, gbuffer.images());
            const HostImage image = pass_list.download(technique->render(pass_list, gbuffer).radiance);
            means.push_back(region_mean([&](unsigned i) {
                const glm::dvec3 radiance = glm::dvec3(image.rgb(i)) * double(image.values[4 * i + 3]);
                return is_specular ? radiance * glm::dvec3(hits[i].reflectance) : radiance;
            }));
        }
        return mean_of(means);
    }
};

/// The largest difference of a channel, in standard errors of the difference. With 48 seeds Student's t of an estimate
/// without bias is beyond 3.5 once in a thousand times.
double deviation(const RegionMean& a, const RegionMean& b) {
    double largest = 0;
    for (int c = 0; c < 3; ++c)
        largest = std::max(largest, std::abs(a.mean[c] - b.mean[c]) / std::hypot(a.error[c], b.error[c]));
    return largest;
}

nlohmann::json form(const std::string& estimator, const nlohmann::json& changes = nlohmann::json::object()) {
    nlohmann::json parameters = {{"estimator", estimator}, {"lobe", "visible_normals"}};
    parameters.update(changes);
    return parameters;
}

/// a and b weigh rays by the BRDF, so that times its integral they are specular radiance; c is the mean over the lobe.
/// With 64 rays per pixel what is left of the ratios' bias is below the interval, whose half-width is 1 % of the mean.
TEST_F(FrostbiteTruth, IsTheMeanOverSeedsOfTheWholeLobe) {
    const auto [on_screen, specular] = truth();
    EXPECT_LT(deviation(found(form("a"), true), specular), 3.5);
    EXPECT_LT(deviation(found(form("b"), true), specular), 3.5);
    EXPECT_LT(deviation(found(form("c", {{"neighbor_ray", "direction"}}), false), on_screen), 3.5);
}

/// All by more than the luck of one in a million (5.6): what is expected of the lobe without its tail, of taking one
/// mean for the other, and of neighbours' hits whose density stays that of the neighbour.
TEST_F(FrostbiteTruth, IsMissedByNarrowLobesOtherWeightsAndForeignDensities) {
    const auto [on_screen, specular] = truth();
    for (const char* lobe : {"normals", "visible_normals"}) {
        const nlohmann::json narrow = {{"importance_bias", 0.7}, {"lobe", lobe}, {"max_rays", 1}};
        EXPECT_GT(deviation(found(form("a", narrow), true), specular), 5.6) << lobe;
        EXPECT_GT(deviation(found(form("c", narrow), false), on_screen), 5.6) << lobe;
    }
    EXPECT_GT(deviation(found(form("c", {{"neighbor_ray", "direction"}}), true), specular), 5.6);
    EXPECT_GT(deviation(found(form("a", {{"reuse_jacobian", false}}), true), specular), 5.6);
}

}  // namespace
