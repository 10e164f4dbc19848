#include "tests/variants/tracer_bench.h"

std::ostream& operator<<(std::ostream& out, const BenchEnd& end) {
    return out << "outcome " << end.outcome << " after " << end.distance << " m at " << end.position.x << ", "
               << end.position.y << ", pixel " << end.pixel.x << ", " << end.pixel.y << ", confidence "
               << end.confidence << ", " << end.fetches << " fetches";
}

float TracerBench::device_depth(float distance) const {
    const glm::vec4 clip = camera.clip_from_view * glm::vec4(0, 0, -distance, 1);
    return clip.z / clip.w;
}

void TracerBench::show(const SyntheticScene& scene) {
    camera = camera_data(pose, nullptr, view);
    PassList pass_list(device_, view.extent);
    const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
    depth = pass_list.download(gbuffer.depth);
    normal = pass_list.download(gbuffer.normal);
}

void TracerBench::show_wall(float distance) {
    camera = camera_data(pose, nullptr, view);
    depth = HostImage(view.extent, 1, device_depth(distance));
    normal = HostImage(view.extent, 4);
    for (size_t i = 0; i < normal.pixel_count(); ++i) normal.set_rgb(i, {0, 0, 1});
}

void TracerBench::set_pixel(glm::uvec2 pixel, float distance, glm::vec3 ws_normal) {
    *depth.pixel(pixel.x, pixel.y) = device_depth(distance);
    normal.set_rgb(size_t(pixel.y) * view.extent.x + pixel.x, ws_normal);
}

void TracerBench::set_column(unsigned x, float distance, glm::vec3 ws_normal) {
    for (unsigned y = 0; y < view.extent.y; ++y) set_pixel({x, y}, distance, ws_normal);
}

glm::vec3 TracerBench::unproject(glm::vec2 screen, float device_depth) const {
    const glm::vec4 v =
        camera.view_from_clip * glm::vec4(screen / glm::vec2(view.extent) * 2.0f - 1.0f, device_depth, 1.0f);
    return glm::vec3(v) / v.w;
}

glm::vec3 TracerBench::position(glm::uvec2 pixel) const {
    return unproject(glm::vec2(pixel) + 0.5f + glm::vec2(camera.jitter), *depth.pixel(pixel.x, pixel.y));
}

glm::vec2 TracerBench::screen(glm::vec3 vs_position) const {
    const glm::vec4 clip = camera.clip_from_view * glm::vec4(vs_position, 1.0f);
    return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(view.extent);
}

BenchRay TracerBench::ray_to(glm::uvec2 from, glm::vec2 to_screen, float distance) const {
    return {from, unproject(to_screen, device_depth(distance)) - position(from)};
}

std::vector<BenchEnd> TracerBench::trace(const std::string& tracer, const std::vector<BenchRay>& rays,
                                         const nlohmann::json& parameters) {
    ParameterSet params;
    Tracers tracers(params, {{"tracer", "trace", "dda", "what the test asks for"}}, "the test");
    params.assign({{"tracer", tracer}});
    params.assign(parameters);

    PassList pass_list(device_, view.extent);
    const auto upload = [&](const char* name, Format format, const HostImage& pixels) {
        const Image image = pass_list.image_of(name, format, pixels.extent);
        pass_list.upload(image, pixels);
        return image;
    };
    const HostImage& shading = shading_normal.values.empty() ? normal : shading_normal;
    const std::vector<Image> inputs{upload("depth", Format::r32f, depth), upload("normal", Format::rgba32f, shading),
                                    upload("geometric_normal", Format::rgba32f, normal)};
    const glm::uvec2 line(unsigned(rays.size()), 1);
    HostImage starts(line, 2), directions(line, 4);
    for (unsigned i = 0; i < line.x; ++i) {
        const glm::vec3 direction = glm::normalize(rays[i].direction);
        for (int c = 0; c < 2; ++c) starts.pixel(i, 0)[c] = float(rays[i].pixel[c]);
        for (int c = 0; c < 3; ++c) directions.pixel(i, 0)[c] = direction[c];
        directions.pixel(i, 0)[3] = rays[i].random;
    }
    const Image start = upload("ray_start", Format::rg32f, starts),
                direction = upload("ray_direction", Format::rgba32f, directions),
                place = pass_list.image_of("end_place", Format::rgba32f, line),
                meeting = pass_list.image_of("end_meeting", Format::rgba32f, line);
    pass_list.begin_frame(camera, params, inputs);
    const Tracers::Images images = tracers.images(pass_list, inputs[0]);
    tracers.run(pass_list,
                pass_list.compute("tracer_rays.comp").read(start).read(direction).write(place).write(meeting),
                {"tracer"}, images, nullptr, 1, [&](PassList::Pass& pass) { pass.run(line); });

    const HostImage places = pass_list.download(place), meetings = pass_list.download(meeting);
    std::vector<BenchEnd> ends;
    for (unsigned i = 0; i < line.x; ++i) {
        const float *p = places.pixel(i, 0), *m = meetings.pixel(i, 0);
        ends.push_back({{int(m[0]), int(m[1])}, {p[0], p[1]}, p[2], p[3], unsigned(m[2]), unsigned(m[3])});
    }
    return ends;
}
