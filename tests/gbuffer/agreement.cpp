#include "tests/gbuffer/agreement.h"

#include "core/gbuffer/gbuffer_transfer.h"
#include "groundtruth/paths/path_tracer.h"

#include <gtest/gtest.h>
#include <cstdio>

namespace {

/// Device depth between neighbouring values of the format around `depth`; float32 near 1 counts as 24 bits.
double depth_step(DepthFormat format, double depth) {
    if (format == DepthFormat::d16) return 1.0 / 65535;
    if (format == DepthFormat::d24) return 1.0 / 16777215;
    return std::max(std::abs(depth), 1e-30) * 0x1p-23;
}

/// What the hit and the G-buffer may differ by in view distance. The depth format's resolution: half a step of it and
/// the float32 rounding of the interpolation, 4 steps in all (for float32: 16, as z = a + b x + c y is summed in it).
/// And where the surface is: vertices are snapped to 1/256 of a pixel, so that depth shifts by its change over 1/64 of
/// a pixel at most.
double depth_tolerance(const CameraData& camera, DepthFormat format, double device_depth, double distance,
                       double change_per_pixel) {
    const double step = depth_step(format, device_depth) * (format == DepthFormat::d32f ? 16 : 4);
    const double nudged = view_distance(camera, float(device_depth + (device_depth > 0.5 ? -step : step)));
    return std::abs(nudged - view_distance(camera, float(device_depth))) + change_per_pixel / 64 + 1e-5 * distance;
}

bool is_edge(const std::vector<FirstHit>& hits, glm::uvec2 extent, unsigned x, unsigned y, double& depth_change) {
    const FirstHit& hit = hits[y * extent.x + x];
    depth_change = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const int nx = int(x) + dx, ny = int(y) + dy;
            if (nx < 0 || ny < 0 || nx >= int(extent.x) || ny >= int(extent.y)) return true;
            const FirstHit& other = hits[ny * extent.x + nx];
            if (other.is_hit != hit.is_hit) return true;
            if (!hit.is_hit) continue;
            if (other.instance != hit.instance || glm::dot(other.geometric_normal, hit.geometric_normal) < 0.98f)
                return true;
            if (std::abs(glm::dot(hit.geometric_normal, other.position - hit.position)) > 0.01f * hit.depth)
                return true;
            depth_change = std::max<double>(depth_change, std::abs(other.depth - hit.depth));
        }
    return false;
}

float angle(glm::vec3 a, const float* b) { return glm::length(a - glm::vec3(b[0], b[1], b[2])); }

}  // namespace

Agreement compare_with_rays(const Scene& scene, const SceneCamera& camera, const FrameView& view,
                            const RasterizerOptions& options) {
    RasterizerOptions sized = options;
    sized.extent = view.extent;
    Rasterizer rasterizer(test_device(), scene, sized);
    const GBuffer gbuffer = rasterizer.render(camera, view);
    const HostGBuffer g = download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), options.depth_format);

    const ScenePose pose = pose_scene(scene, float(view.frame));
    const PathTracer tracer(scene, pose, pose_camera(camera, pose, float(view.frame)), view.extent, {});
    std::vector<FirstHit> hits;
    for (unsigned y = 0; y < view.extent.y; ++y)
        for (unsigned x = 0; x < view.extent.x; ++x) hits.push_back(tracer.first_hit(x, y));

    Agreement result;
    for (unsigned y = 0; y < view.extent.y; ++y)
        for (unsigned x = 0; x < view.extent.x; ++x) {
            double change;
            if (is_edge(hits, view.extent, x, y, change)) continue;
            const FirstHit& hit = hits[y * view.extent.x + x];
            ++result.compared;
            const float depth = *g.depth.pixel(x, y);
            result.material += *g.material_id.pixel(x, y) == (hit.is_hit ? hit.material + 1 : 0);
            if (!hit.is_hit) {
                const bool is_far = depth == g.camera.depth.z;
                result.depth += is_far, ++result.geometric_normal, ++result.normal, ++result.surface;
                continue;
            }
            // On a floor of 240 m barycentrics place Embree's hit within some 0.01 mm only; position_error bounds that.
            const double tolerance = depth_tolerance(g.camera, options.depth_format, depth, hit.depth, change) +
                                     glm::length(hit.position_error);
            result.depth += std::abs(view_distance(g.camera, depth) - hit.depth) <= tolerance;
            // Both transform the same float32 normal of the triangle.
            result.geometric_normal += angle(hit.geometric_normal, g.geometric_normal.pixel(x, y)) < 1e-4f;
            // Shading normals and textures change over the surface: 1/100 for where in the pixel they are read.
            result.normal += angle(hit.normal, g.normal.pixel(x, y)) < 0.01f;
            const float *c = g.base_color.pixel(x, y), *e = g.emission.pixel(x, y);
            const float usual_f0[3] = {usual_dielectric_f0, usual_dielectric_f0, usual_dielectric_f0};
            const float* own_f0 = g.dielectric_f0.values.empty() ? usual_f0 : g.dielectric_f0.pixel(x, y);
            const glm::vec4 color = hit.is_unlit ? glm::vec4(0) : glm::vec4(hit.base_color, hit.metalness);
            const float difference =
                glm::length(color - glm::vec4(c[0], c[1], c[2], c[3])) + angle(hit.emitted, e) +
                std::abs(hit.roughness - (hit.is_unlit ? hit.roughness : g.normal.pixel(x, y)[3])) +
                std::abs(hit.specular - e[3]) + angle(hit.dielectric_f0, own_f0);
            result.surface += difference < 0.02f;
        }
    return result;
}

void expect_agreement(const Agreement& a, const std::string& name) {
    const auto percent = [&](size_t n) { return 100.0 * n / std::max<size_t>(a.compared, 1); };
    std::printf(
        "%-40s %6zu pixels: depth %.3f %%, geometric normal %.3f %%, normal %.3f %%, material %.3f %%, surface %.3f "
        "%%\n",
        name.c_str(), a.compared, percent(a.depth), percent(a.geometric_normal), percent(a.normal), percent(a.material),
        percent(a.surface));
    EXPECT_GE(percent(a.depth), 99.9) << name;
    EXPECT_GE(percent(a.geometric_normal), 99.9) << name;
    EXPECT_GE(percent(a.normal), 99.9) << name;
    EXPECT_GE(percent(a.material), 99.9) << name;
    EXPECT_GE(percent(a.surface), 99.9) << name;
}
