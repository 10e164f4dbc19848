#include "tests/variants/synthetic_gbuffer.h"

namespace {

float device_depth(const CameraData& camera, glm::vec3 position) {
    const glm::vec4 clip = camera.clip_from_world * glm::vec4(position, 1.0f);
    return clip.z / clip.w;
}

void set_pixel(HostImage& image, unsigned x, unsigned y, glm::vec4 value) {
    for (unsigned channel = 0; channel < image.channels; ++channel) image.pixel(x, y)[channel] = value[int(channel)];
}

}  // namespace

GBuffer upload_gbuffer(PassList& pass_list, const CameraPose& pose, const CameraData& camera,
                       const SyntheticScene& scene) {
    const glm::uvec2 extent = pass_list.extent();
    HostImage depth(extent, 1, camera.depth.z), normal(extent, 4), base_color(extent, 4), emission(extent, 4),
        lit(extent, 4), dielectric_f0(extent, 4);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const CameraRay ray = camera_ray(pose, extent, glm::vec2(x, y) + 0.5f + glm::vec2(camera.jitter));
            const SyntheticHit hit = scene(ray);
            set_pixel(lit, x, y, glm::vec4(hit.lit, 1.0f));
            if (std::isinf(hit.distance)) continue;
            set_pixel(depth, x, y, glm::vec4(device_depth(camera, ray.origin + hit.distance * ray.direction)));
            set_pixel(normal, x, y, glm::vec4(hit.normal, hit.roughness));
            set_pixel(base_color, x, y, glm::vec4(1.0f, 1.0f, 1.0f, hit.metalness));
            set_pixel(emission, x, y, glm::vec4(0.0f, 0.0f, 0.0f, hit.specular));
            set_pixel(dielectric_f0, x, y, glm::vec4(hit.dielectric_f0, 0.0f));
        }
    GBuffer gbuffer;
    const auto upload = [&](Image& image, const char* name, Format format, const HostImage& pixels) {
        image = pass_list.image(name, format);
        pass_list.upload(image, pixels);
    };
    upload(gbuffer.depth, "depth", Format::r32f, depth);
    upload(gbuffer.normal, "normal", Format::rgba32f, normal);
    upload(gbuffer.geometric_normal, "geometric_normal", Format::rgba32f, normal);
    upload(gbuffer.base_color, "base_color", Format::rgba32f, base_color);
    upload(gbuffer.emission, "emission", Format::rgba32f, emission);
    upload(gbuffer.dielectric_f0, "dielectric_f0", Format::rgba32f, dielectric_f0);
    gbuffer.has_dielectric_f0 = true;
    upload(gbuffer.lit, "lit", Format::rgba32f, lit);
    upload(gbuffer.motion, "motion", Format::rg32f, HostImage(extent, 2));
    upload(gbuffer.material_id, "material_id", Format::r32ui, HostImage(extent, 1, 1.0f));
    upload(gbuffer.fallback, "fallback", Format::rgba32f, HostImage(extent, 4));
    gbuffer.previous_depth = gbuffer.depth.as("previous_depth");
    gbuffer.previous_normal = gbuffer.normal.as("previous_normal");
    return gbuffer;
}

HostImage motion_of(const CameraPose& pose, const CameraData& camera, const SyntheticScene& scene, glm::vec3 way) {
    const glm::uvec2 extent(camera.extent);
    HostImage motion(extent, 2);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const glm::vec2 sample = glm::vec2(x, y) + 0.5f + glm::vec2(camera.jitter);
            const CameraRay ray = camera_ray(pose, extent, sample);
            const float distance = scene(ray).distance;
            if (std::isinf(distance)) continue;
            const glm::vec4 clip =
                camera.previous_clip_from_world * glm::vec4(ray.origin + distance * ray.direction - way, 1);
            const glm::vec2 before = glm::vec2(clip) / clip.w * 0.5f + 0.5f;
            for (int i = 0; i < 2; ++i) motion.pixel(x, y)[i] = sample[i] / float(extent[i]) - before[i];
        }
    return motion;
}

HostGBuffer host_gbuffer(Device& device, const CameraPose& pose, const FrameView& view, const SyntheticScene& scene) {
    PassList pass_list(device, view.extent);
    const CameraData camera = camera_data(pose, nullptr, view);
    return download_gbuffer(pass_list, upload_gbuffer(pass_list, pose, camera, scene), camera, DepthFormat::d32f);
}

SyntheticHit mirror_floor(const CameraRay& ray) {
    const float to_wall = (-6.0f - ray.origin.z) / ray.direction.z;
    const float to_floor =
        ray.direction.y < 0.0f ? (-1.0f - ray.origin.y) / ray.direction.y : std::numeric_limits<float>::infinity();
    if (to_floor < to_wall)
        return {.distance = to_floor, .normal = {0, 1, 0}, .roughness = 0, .metalness = 1, .specular = 1, .lit = {}};
    const bool is_white = ray.origin.y + to_wall * ray.direction.y > 1.0f;
    return {.distance = to_wall, .normal = {0, 0, 1}, .lit = glm::vec3(is_white ? 1.0f : 0.25f)};
}
