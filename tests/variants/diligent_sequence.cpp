#include "tests/variants/diligent_sequence.h"

namespace {

/// uv of a world-space point.
glm::vec2 uv_of(const glm::mat4& clip_from_world, glm::vec3 p) {
    const glm::vec4 clip = clip_from_world * glm::vec4(p, 1);
    return glm::vec2(clip) / clip.w * 0.5f + 0.5f;
}

/// Of points that moved by `way` (m) since the frame before.
glm::vec2 motion_of(const CameraData& camera, glm::vec3 p, glm::vec3 way) {
    return uv_of(camera.clip_from_world, p) - uv_of(camera.previous_clip_from_world, p - way);
}

}  // namespace

CameraPose DiligentSequence::pose(unsigned frame) const {
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    pose.world_from_view =
        glm::translate(glm::mat4(1), float(frame) * speed) * glm::rotate(glm::mat4(1), 0.07f, glm::vec3(0.3f, 0, 1));
    return pose;
}

std::vector<HostGBuffer> DiligentSequence::frames(unsigned count, const SceneOfFrame& scene) const {
    std::vector<HostGBuffer> frames;
    PassList pass_list(device(), view.extent);
    for (unsigned frame = 0; frame < count; ++frame) {
        FrameView now = view;
        now.frame = frame;
        const CameraPose here = pose(frame), before = pose(frame > 0 ? frame - 1 : 0);
        const CameraData camera = camera_data(here, frame > 0 ? &before : nullptr, now);
        const SyntheticScene shown = scene(frame);
        HostGBuffer host =
            download_gbuffer(pass_list, upload_gbuffer(pass_list, here, camera, shown), camera, DepthFormat::d32f);
        if (frame > 0) host.previous_depth = frames.back().depth;
        for (unsigned y = 0; frame > 0 && y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) {
                const CameraRay ray = camera_ray(here, view.extent, glm::vec2(x, y) + 0.5f + view.jitter);
                const SyntheticHit hit = shown(ray);
                const glm::vec3 way(hit.metalness > 0 ? 0 : wall_speed, 0, 0);
                const glm::vec2 motion = motion_of(camera, ray.origin + hit.distance * ray.direction, way);
                host.motion.pixel(x, y)[0] = motion.x;
                host.motion.pixel(x, y)[1] = motion.y;
            }
        frames.push_back(std::move(host));
    }
    return frames;
}

HostImage DiligentSequence::render(Technique& technique, const std::vector<HostGBuffer>& frames) {
    PassList pass_list(device(), view.extent);
    Reflections reflections;
    for (const HostGBuffer& host : frames) {
        const GBuffer gbuffer = upload_gbuffer(pass_list, host);
        pass_list.begin_frame(host.camera, technique.params, gbuffer.images());
        reflections = technique.render(pass_list, gbuffer);
        times = pass_list.times();
    }
    EXPECT_EQ(reflections.confidence_channel, 3u);
    return pass_list.download(reflections.radiance);
}

HostImage DiligentSequence::composited_incident(Technique& technique, std::vector<HostGBuffer> frames, float fallback) {
    for (HostGBuffer& frame : frames) frame.fallback = HostImage(view.extent, 4, fallback);
    const HostGBuffer& last = frames.back();
    const HostImage reflections = render(technique, frames);
    PassList pass_list(device(), view.extent);
    const GBuffer gbuffer = upload_gbuffer(pass_list, last);
    const Image uploaded = pass_list.image("reflections", Format::rgba32f);
    pass_list.upload(uploaded, reflections);
    pass_list.begin_frame(last.camera, technique.params, gbuffer.images());
    Compositor compositor(pass_list);
    HostImage incident = pass_list.download(compositor.render(gbuffer, {uploaded, uploaded, 3}).specular);
    const HostImage furnace = specular_reflectance(last);
    for (size_t i = 0; i < incident.pixel_count(); ++i)
        for (unsigned c = 0; c < 4; ++c) {
            float& value = incident.values[4 * i + c];
            const bool reflects = c < 3 && furnace.values[3 * i + c] > 0;
            value = reflects ? value / furnace.values[3 * i + c] : 1;
        }
    return incident;
}
