#include "experiments/bridges/scene_for/scene_folder.h"

#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/near_miss.h"
#include "core/number_text.h"
#include "core/path_inside.h"
#include "core/shared/environment.h"
#include "experiments/bridges/scene_for/raw_files.h"
#include "experiments/bridges/scene_for/scene_glb.h"
#include "experiments/bridges/scene_for/scene_numbers.h"
#include "experiments/study/config/points/external_images.h"
#include "experiments/study/config/shots/scene_warnings.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/measure.h"
#include "experiments/study/measuring/reflection_probe.h"
#include "groundtruth/reference/reference_cache.h"

#include <cstdio>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

class FolderWriter {
public:
    explicit FolderWriter(const SceneFolderSettings& settings) : settings_(settings) {}

    SceneFolder write() {
        std::vector<Shot> shots;
        const std::vector<std::string> first = {""};
        for (const std::string& camera : settings_.cameras.empty() ? first : settings_.cameras)
            shots.push_back(load_shot({.scene = settings_.scene,
                                       .choices = settings_.choices,
                                       .camera = camera,
                                       .extent = settings_.extent,
                                       .frames = settings_.frames},
                                      settings_.search_path));
        const Scene& scene = shots.front().scene;  // that of all
        if (settings_.has_probe && shots.size() > 1)
            fail(settings_.scene, ": a probe is one camera's, and ", shots.size(),
                 " were named: write a folder for each");
        check_shapes(scene);
        done_.warnings = warning_sentences(scene);
        if (scene.hides_backs())
            done_.warnings.push_back(
                "This scene hides the backs of single-sided materials: scene.glb says so of each ('doubleSided'). An "
                "adapter that draws both sides renders another scene; \"back_faces\": \"drawn\" in scene.json makes "
                "both the same.");
        json description = {{"scene", scene.name},
                            {"engine", settings_.engine.name},
                            {"samples", settings_.reference.max_samples},
                            {"background", background(settings_.has_probe ? probe(shots.front()) : scene.environment)}};
        std::vector<GlbCamera> cameras;
        for (const Shot& shot : shots) {
            cameras.push_back({.lens = lens_of(shot),
                               .world_from_camera = shot_frame(shot, settings_.frames.front()).camera.world_from_view,
                               .aspect = float(settings_.extent.x) / float(settings_.extent.y)});
            description["views"].push_back(view(shot));
        }
        const ScenePose first_pose = shot_frame(shots.front(), settings_.frames.front()).scene;
        write_scene_glb(settings_.out / "scene.glb", scene, first_pose, cameras);
        if (is_raw()) {
            write_raw_meshes(settings_.out, scene, first_pose, instance_names(scene));
            description["meshes"] = "scene.meshes.json";
        }
        write_text(settings_.out / "scene.json", description.dump() + "\n");
        return std::move(done_);
    }

private:
    /// With the field of view that it has in the pictures.
    SceneCamera lens_of(const Shot& shot) const {
        const CameraPose pose =
            fitted(shot_frame(shot, settings_.frames.front()).camera, double(settings_.extent.x) / settings_.extent.y);
        SceneCamera lens = shot.camera;
        lens.vertical_fov = pose.vertical_fov, lens.orthographic_height = pose.orthographic_height, lens.aspect = 0.0f;
        return lens;
    }

    /// Frames differ by the matrices of nodes alone.
    void check_shapes(const Scene& scene) const {
        const auto shapes_in = [&](unsigned frame) { return pose_scene(scene, float(frame)).deformations; };
        const std::vector<Deformation> first = shapes_in(settings_.frames.front());
        if (first.empty()) return;
        for (const unsigned frame : settings_.frames) {
            const std::vector<Deformation> now = shapes_in(frame);
            for (size_t i = 0; i < first.size(); ++i)
                if (now[i] != first[i])
                    fail(settings_.scene, ": joints or morph targets give node '",
                         shortened(scene.nodes[scene.instances[i].node].name), "' other shapes in frames ",
                         settings_.frames.front(), " and ", frame,
                         ", and the folder has one shape of each node: write a folder for each frame (--frames)");
        }
    }

    bool is_raw() const { return settings_.engine.format == SceneFormat::raw; }

    /// As shots have it that fall back to a probe (experiments/study/shots/open_shot.cpp), from the same cached views.
    Environment probe(const Shot& shot) {
        const ShotFrame first = shot_frame(shot, settings_.frames.front());
        return reflection_probe(first.camera.world_from_view[3], settings_.reference,
                                [&](const CameraPose& camera, glm::uvec2 extent, const ReferenceSettings& of_face) {
                                    return cached_reference(shot.scene, first.scene, camera, extent, of_face,
                                                            settings_.cache, {});
                                });
    }

    json background(const Environment& environment) {
        if (environment.type == Environment::Type::constant) return {{"color", numbers_of(environment.color)}};
        const bool is_image = environment.type == Environment::Type::image;
        const HostImage image = is_image ? environment.latlong : drawn(environment);
        write_exr(settings_.out / "environment.exr", image);
        write_hdr(settings_.out / "environment.hdr", image);
        json entry = {{"image", "environment.exr"},
                      {"hdr", "environment.hdr"},
                      {"rotation", number_of(is_image ? environment.rotation : 0.0f)},
                      {"orientation", "u = 0.5 + (atan2(z, x) + rotation) / (2 pi), v = acos(y) / pi; first row: +y"}};
        if (is_raw()) {
            write_raw_floats(settings_.out / "environment.f32", image);
            entry["raw"] = "environment.f32", entry["width"] = image.extent.x, entry["height"] = image.extent.y;
        }
        return entry;
    }

    /// A gradient as an image.
    static HostImage drawn(const Environment& environment) {
        constexpr glm::uvec2 extent{512, 256};
        HostImage image(extent, 3);
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / glm::vec2(extent);
                image.set_rgb(size_t(y) * extent.x + x, environment.radiance(environment_direction(uv, 0.0f)));
            }
        return image;
    }

    json view(const Shot& shot) {
        const std::string name = ExternalImages::view_name(shot);
        const SceneCamera lens = lens_of(shot);
        json view = {{"view", name},
                     {"camera", lens.name},
                     {"width", settings_.extent.x},
                     {"height", settings_.extent.y},
                     {"near", number_of(lens.near)},
                     {"far", number_of(lens.far)}};
        if (lens.is_orthographic)
            view["orthographic_height"] = number_of(lens.orthographic_height);
        else
            view["vertical_fov"] = number_of(lens.vertical_fov);
        const std::vector<std::string> names = instance_names(shot.scene);
        for (const unsigned frame : settings_.frames) {
            const ShotFrame now = shot_frame(shot, frame);
            json nodes = json::object();
            for (size_t i = 0; i < names.size(); ++i)
                nodes[names[i]] = matrix_numbers(now.scene.world_from_instance[i]);
            view["frames"].push_back(frame_of(name, shot, now));
            view["frames"].back()["nodes"] = std::move(nodes);
        }
        done_.views.push_back(name);
        return view;
    }

    /// Light is what external images are compared with where nothing reflects, PoseTruth::direct; by each half of its
    /// samples alone, what its noise does to reflections can be seen. Depth shows an adapter whether its camera and
    /// geometry are the scene's.
    json frame_of(const std::string& view, const Shot& shot, const ShotFrame& now) {
        const std::string stem = view + "/f" + std::to_string(now.frame);
        const Reference reference = reference_of(shot, now);
        write_exr(
            path_inside(settings_.out, stem + ".depth.exr"),
            LayeredImage{.layers = {{.name = "", .channel_names = "Y", .image = reference.depth}}, .attributes = {}});
        json entry = {{"frame", now.frame},
                      {"world_from_camera", matrix_numbers(now.camera.world_from_view)},
                      {"depth", stem + ".depth.exr"}};
        if (is_raw()) {
            write_raw_floats(path_inside(settings_.out, stem + ".depth.f32"), reference.depth);
            entry["depth_raw"] = stem + ".depth.f32";
        }
        const LightFiles whole = write_light(stem + ".light", sum(reference.diffuse.mean, reference.highlights));
        entry["light"] = whole.exr;
        if (is_raw()) entry["light_raw"] = whole.raw;
        if (reference.diffuse.half_a.values == reference.diffuse.half_b.values) return entry;  // it has no noise
        for (const auto& [name, half] :
             {std::pair(".half_a", &reference.diffuse.half_a), {".half_b", &reference.diffuse.half_b}}) {
            const LightFiles files = write_light(stem + name, sum(*half, reference.highlights));
            entry["light_halves"].push_back(files.exr);
            if (is_raw()) entry["light_halves_raw"].push_back(files.raw);
        }
        return entry;
    }

    struct LightFiles {
        std::string exr, raw;  ///< the second is written for some engines alone
    };

    LightFiles write_light(const std::string& stem, const HostImage& light) {
        const LightFiles files{.exr = stem + ".exr", .raw = stem + ".f32"};
        write_exr(path_inside(settings_.out, files.exr), light);
        if (is_raw()) write_raw_floats(path_inside(settings_.out, files.raw), light);
        return files;
    }

    Reference reference_of(const Shot& shot, const ShotFrame& now) {
        ReferenceRun run;
        const std::string what = shot.name() + ": light of frame " + std::to_string(now.frame);
        run.progress = [&](double fraction, double rays_per_second, double) {
            const double frames = double(done_.rendered + done_.cached);
            const double all = double(settings_.frames.size() * std::max(settings_.cameras.size(), size_t(1)));
            settings_.report((frames + fraction) / all, what + ", " + ray_rate_text(rays_per_second));
        };
        run.notice = [&](const std::string& text) { settings_.say("note: " + text); };
        Reference reference = cached_reference(shot.scene, now.scene, now.camera, settings_.extent, settings_.reference,
                                               settings_.cache, run);
        ++(reference.from_cache ? done_.cached : done_.rendered);
        return reference;
    }

    const SceneFolderSettings& settings_;
    SceneFolder done_;
};

}  // namespace

const std::vector<SceneEngine>& scene_engines() {
    static const std::vector<SceneEngine> engines = {
        {"any", "all formats, for an adapter of your own", SceneFormat::raw},
        {"three", "three.js and what builds on it", SceneFormat::gltf},
        {"babylon", "Babylon.js", SceneFormat::gltf},
        {"eevee", "Blender", SceneFormat::gltf},
        {"godot", "Godot 3, which reads neither glTF nor EXR at run time", SceneFormat::raw}};
    return engines;
}

SceneFolder write_scene_folder(const SceneFolderSettings& settings) { return FolderWriter(settings).write(); }
