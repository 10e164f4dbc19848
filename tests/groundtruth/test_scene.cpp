#include "tests/groundtruth/test_scene.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

TestScene::TestScene() {
    scene.name = "test";
    scene.environment.color = glm::vec3(0.0f);
}

unsigned TestScene::add(const Material& material) {
    scene.materials.push_back(material);
    return unsigned(scene.materials.size() - 1);
}

void TestScene::mesh(Mesh mesh, const glm::mat4& world_from_object) {
    scene.meshes.push_back(std::move(mesh));
    scene.nodes.push_back({});
    scene.instances.push_back({unsigned(scene.meshes.size() - 1), unsigned(scene.nodes.size() - 1)});
    transforms_.push_back(world_from_object);
}

void TestScene::quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, unsigned material) {
    Mesh quad{.name = "quad", .material = material};
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const glm::vec2 uv[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const glm::vec3 corners[4] = {a, b, c, d};
    const glm::vec4 tangent(glm::normalize(b - a), 1.0f);
    for (int i = 0; i < 4; ++i) quad.vertices.push_back({corners[i], normal, tangent, {uv[i], uv[i]}, glm::vec4(1.0f)});
    quad.indices = {0, 1, 2, 0, 2, 3};
    mesh(std::move(quad));
}

void TestScene::sphere(glm::vec3 center, float radius, int n, unsigned material, bool is_inward) {
    Mesh sphere{.name = "sphere", .material = material};
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= 2 * n; ++i) {
            const double polar = M_PI * j / n, azimuth = M_PI * (i % (2 * n)) / n;
            const glm::dvec3 direction(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                       std::sin(polar) * std::sin(azimuth));
            const glm::vec3 normal(is_inward ? -direction : direction);
            const glm::vec2 uv(float(i) / float(2 * n), float(j) / float(n));
            sphere.vertices.push_back(
                {center + radius * glm::vec3(direction), normal, {1, 0, 0, 1}, {uv, uv}, glm::vec4(1.0f)});
        }
    const auto at = [&](int i, int j) { return uint32_t(j * (2 * n + 1) + i); };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < 2 * n; ++i) {
            const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
            const std::vector<uint32_t> outward = {a, b, c, a, c, d}, inward = {a, c, b, a, d, c};
            const std::vector<uint32_t>& corners = is_inward ? inward : outward;
            // One of the two triangles has no area at each pole.
            if (j > 0) sphere.indices.insert(sphere.indices.end(), corners.begin(), corners.begin() + 3);
            if (j < n - 1) sphere.indices.insert(sphere.indices.end(), corners.begin() + 3, corners.end());
        }
    mesh(std::move(sphere));
}

void TestScene::room(glm::vec3 a, glm::vec3 b, unsigned material) {
    quad({a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, a.y, a.z}, {a.x, a.y, a.z}, material);
    quad({a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}, material);
    quad({a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}, material);
    quad({b.x, a.y, b.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, material);
    quad({a.x, a.y, b.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}, material);
    quad({b.x, a.y, a.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}, material);
}

ScenePose TestScene::pose() const {
    return {.world_from_instance = transforms_,
            .deformations = {},
            .world_from_node = std::vector<glm::mat4>(scene.nodes.size(), glm::mat4(1.0f)),
            .lights = scene.lights};
}

Material lambert_material(float albedo, float emission) {
    Material material;
    material.base_color = glm::vec3(albedo);
    material.metalness = 0.0f;
    material.specular = 0.0f;
    material.emission = glm::vec3(emission);
    return material;
}

Material metal_material(float f0, float roughness) {
    Material material;
    material.base_color = glm::vec3(f0);
    material.roughness = roughness;
    return material;
}

CameraPose looking_along(glm::vec3 eye, glm::vec3 direction) {
    CameraPose pose;
    pose.is_orthographic = true;
    pose.orthographic_height = 0.01f;
    pose.near = 0.0f, pose.far = 1e9f;  // cut nothing
    const glm::vec3 up =
        std::abs(direction.y) < 0.9f * glm::length(direction) ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    pose.world_from_view =
        glm::mat4(glm::inverse(glm::lookAt(glm::dvec3(eye), glm::dvec3(eye) + glm::dvec3(direction), glm::dvec3(up))));
    return pose;
}

CameraPose looking_at_origin(glm::vec3 normal, glm::vec3 towards, float cosine) {
    const glm::dvec3 view =
        double(cosine) * glm::dvec3(normal) + std::sqrt(1 - double(cosine) * cosine) * glm::dvec3(towards);
    return looking_along(glm::vec3(view), glm::vec3(-view));
}

PixelMoments render_pixel(const PathTracer& tracer, unsigned x, unsigned y, unsigned samples_per_batch, uint64_t seed,
                          Directions directions) {
    PixelMoments result;
    result.hit = tracer.first_hit(x, y);
    std::array<glm::dvec3, batch_count> means[5];
    double on_screen = 0, lobe = 0;
    std::array<SampleBatch, batch_count> batches;
    for (unsigned batch = 0; batch < batch_count; ++batch) batches[batch].seed = seed * 1000 + batch;
    tracer.trace(x, y, result.hit, 0, samples_per_batch, batches, directions);
    for (unsigned batch = 0; batch < batch_count; ++batch) {
        const PixelEstimate& estimate = batches[batch].estimate;
        means[0][batch] = estimate.diffuse / double(estimate.samples) + glm::dvec3(result.hit.emitted);
        means[1][batch] = estimate.specular / double(estimate.samples);
        const double lobe_samples = double(estimate.lobe_samples),
                     hidden = lobe_samples - double(estimate.on_screen_samples);
        const glm::dvec3 over_lobe[] = {estimate.incident, estimate.camera_radiance,
                                        estimate.on_screen + hidden * glm::dvec3(result.hit.fallback)};
        for (int i = 0; i < 3; ++i)
            means[2 + i][batch] = lobe_samples > 0 ? over_lobe[i] / lobe_samples : glm::dvec3(0.0);
        on_screen += double(estimate.on_screen_samples);
        lobe += lobe_samples;
        result.cut +=
            (estimate.cut.x + estimate.cut.y + estimate.cut.z) / (3.0 * batch_count * double(estimate.samples));
        result.non_finite += estimate.non_finite;
    }
    if (lobe > 0) result.on_screen_share = on_screen / lobe;
    Moments* moments[5] = {&result.diffuse, &result.specular, &result.incident, &result.camera_radiance,
                           &result.on_screen};
    for (int output = 0; output < 5; ++output) {
        for (const glm::dvec3& mean : means[output]) moments[output]->mean += mean / double(batch_count);
        glm::dvec3 squares(0.0);
        for (const glm::dvec3& mean : means[output])
            squares += (mean - moments[output]->mean) * (mean - moments[output]->mean);
        moments[output]->standard_error = glm::sqrt(squares / double(batch_count * (batch_count - 1)));
    }
    return result;
}

PixelMoments render(const TestScene& scene, const CameraPose& camera, unsigned samples_per_batch,
                    PathTracerSettings settings, uint64_t seed) {
    const ScenePose pose = scene.pose();
    return render_pixel(PathTracer(scene.scene, pose, camera, {1, 1}, settings), 0, 0, samples_per_batch, seed);
}

double polygon_form_factor(glm::dvec3 point, glm::dvec3 normal, const std::vector<glm::dvec3>& corners) {
    double sum = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - point),
                         b = glm::normalize(corners[(i + 1) % corners.size()] - point);
        const glm::dvec3 edge = glm::cross(a, b);
        const double sine = glm::length(edge);
        if (sine > 0) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(edge / sine, normal);
    }
    return -sum / (2 * M_PI);
}

double mesh_form_factor(const TestScene& scene, size_t index, glm::dvec3 point, glm::dvec3 normal) {
    const Mesh& mesh = scene.scene.meshes[index];
    double sum = 0;
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        std::vector<glm::dvec3> corners;
        for (int k = 0; k < 3; ++k) corners.push_back(glm::dvec3(mesh.vertices[mesh.indices[t + k]].position));
        const glm::dvec3 front = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (glm::dot(front, point - corners[0]) > 0) sum += polygon_form_factor(point, normal, corners);
    }
    return sum;
}
