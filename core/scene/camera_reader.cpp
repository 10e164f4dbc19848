#include "core/scene/camera_reader.h"

#include "core/error.h"
#include "core/scene/camera_planes.h"
#include "core/scene/ranges.h"

#include <cmath>

namespace {
const int any_frames = 1000000;

CameraKey read_key(JsonObject& object, float frame, glm::vec3 up) {
    const glm::vec3 position = read_position(object, "position"), target = read_position(object, "target");
    if (!(glm::length(glm::cross(target - position, up)) > 0.0f))
        fail(object.where(), ": 'target' must differ from 'position', and not lie along 'up' from it");
    return {frame, position, target, up};
}

std::vector<CameraKey> read_path(JsonObject& object, glm::vec3 up) {
    std::vector<CameraKey> keys;
    for (JsonObject& step : object.objects("path")) {
        const float frame = step.number("frame", 0.0f, float(any_frames));
        if (!keys.empty() && frame <= keys.back().frame)
            fail(step.where(), ": 'frame' = ", frame, " must be later than that of the key before");
        keys.push_back(read_key(step, frame, up));
        step.finish();
    }
    if (keys.empty()) fail(object.where(), ": 'path' is empty");
    return keys;
}

bool asks_for_planes_of_scene(JsonObject& object) {
    if (!object.has("planes")) return false;
    object.choice("planes", {"scene"}, "scene");
    for (const char* plane : {"near", "far"})
        if (object.has(plane)) fail(object.where(), ": has '", plane, "' and 'planes': leave one of them out");
    return true;
}

SceneCamera gltf_camera(JsonObject& object, const Scene& scene) {
    const std::string name = object.text("gltf");
    SceneCamera camera = scene.camera(name);
    camera.name = object.text("name", name);
    camera.exposure_ev = object.number("exposure_ev", -100.0f, 100.0f, 0.0f);
    camera.frame_count = unsigned(object.integer("frames", 1, any_frames, int(camera.frame_count)));
    if (asks_for_planes_of_scene(object)) use_planes_of_scene(camera, scene);
    object.finish();
    return camera;
}

void read_lens(JsonObject& object, SceneCamera& camera) {
    camera.is_orthographic = object.has("orthographic_height");
    if (camera.is_orthographic)
        camera.orthographic_height = object.number("orthographic_height", 1e-9f, any_length);
    else
        camera.vertical_fov = glm::radians(object.number("vfov_deg", 0.01f, 179.0f));
}

void read_planes(JsonObject& object, const Scene& scene, SceneCamera& camera) {
    asks_for_planes_of_scene(object);  // as they are where the entry gives none
    const bool is_complete = object.has("near") && object.has("far");
    const CameraPlanes planes = is_complete ? CameraPlanes{} : derive_planes(camera, scene);
    camera.near = object.number("near", camera.is_orthographic ? 0.0f : 1e-9f, any_length, planes.near);
    camera.far = object.number("far", 1e-9f, any_length, planes.far);
    if (!(camera.near < camera.far))
        fail(object.where(), ": 'near' = ", camera.near, " must be less than 'far' = ", camera.far);
}
}  // namespace

glm::vec3 read_direction(JsonObject& object, const std::string& key) {
    const glm::dvec3 v(object.vector(key));  // squares of any float32 are finite, and not 0, in double
    if (!(glm::length(v) > 0.0)) fail(object.where(), ": '", key, "' has no length");
    return glm::vec3(glm::normalize(v));
}

glm::vec3 read_position(JsonObject& object, const std::string& key) {
    const glm::vec3 v = object.vector(key);
    for (int i = 0; i < 3; ++i)
        if (!(std::abs(v[i]) <= any_length))
            fail(object.where(), ": '", key, "' has the coordinate ", v[i], " outside of [", -any_length, ", ",
                 any_length, "] m");
    return v;
}

SceneCamera read_camera(JsonObject object, const Scene& scene) {
    if (object.has("gltf")) return gltf_camera(object, scene);
    SceneCamera camera{.name = object.text("name")};
    const glm::vec3 up = object.has("up") ? read_direction(object, "up") : glm::vec3(0.0f, 1.0f, 0.0f);
    read_lens(object, camera);
    camera.keys = object.has("path") ? read_path(object, up) : std::vector<CameraKey>{read_key(object, 0.0f, up)};
    camera.exposure_ev = object.number("exposure_ev", -100.0f, 100.0f, 0.0f);
    camera.frame_count = unsigned(object.integer("frames", 1, any_frames, int(camera.keys.back().frame) + 1));
    read_planes(object, scene, camera);
    object.finish();
    return camera;
}
