#include "experiments/study/measuring/frames/capture.h"

#include "core/error.h"
#include "core/files.h"
#include "core/gbuffer/camera_file.h"
#include "core/gbuffer/gbuffer_checks.h"
#include "core/gbuffer/pixel_position.h"
#include "core/numbered_files.h"
#include "core/path_inside.h"
#include "experiments/study/config/shots/capture_folder.h"
#include "experiments/study/view_name.h"
#include "groundtruth/reference/reference_file.h"

#include <algorithm>
#include <cmath>

namespace fs = std::filesystem;

namespace {

/// Of frames that are kept in memory, so that playing a short capture again reads no file.
constexpr size_t max_loaded_bytes = size_t(1) << 30;

/// What the results call a capture: the name of its folder.
std::string capture_name(const fs::path& folder) {
    return fs::absolute(folder / "").lexically_normal().parent_path().filename().string();
}

bool differ(const glm::mat4& a, const glm::mat4& b) {
    // Exporters invert and multiply in float32; the frame before of a camera that creeps differs by more.
    constexpr float tolerance = 1e-4f;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (std::abs(a[column][row] - b[column][row]) >
                tolerance * std::max(1.0f, std::max(std::abs(a[column][row]), std::abs(b[column][row]))))
                return true;
    return false;
}

float surface_distance(const HostGBuffer& g, float device_depth) {
    return device_depth == g.camera.depth.z ? 0.0f : view_distance(g.camera, device_depth);
}

/// Share of the pixels whose distances differ by more than 1 %.
double share_that_differs(const HostImage& expected, const std::function<float(size_t)>& distance) {
    size_t count = 0;
    for (size_t i = 0; i < expected.values.size(); ++i)
        count += std::abs(distance(i) - expected.values[i]) > 0.01f * std::max(distance(i), expected.values[i]);
    return double(count) / double(expected.values.size());
}

HostImage surface_distances(const HostGBuffer& g, const HostImage& depth) {
    HostImage distances(depth.extent, 1);
    for (size_t i = 0; i < depth.values.size(); ++i) distances.values[i] = surface_distance(g, depth.values[i]);
    return distances;
}

/// Sentences by what they say, each with the frames that it is about.
struct FrameNotes {
    std::vector<std::pair<std::string, std::vector<unsigned>>> entries;

    void add(const std::string& text, unsigned frame) {
        const auto found = std::ranges::find(entries, text, &std::pair<std::string, std::vector<unsigned>>::first);
        (found == entries.end() ? entries.emplace_back(text, std::vector<unsigned>{}) : *found).second.push_back(frame);
    }
    std::vector<std::string> texts(size_t of_frames) const {
        std::vector<std::string> list;
        for (const auto& [text, frames] : entries) {
            const std::string more = frames.size() > 1 ? " and " + std::to_string(frames.size() - 1) + " more: " : ": ";
            list.push_back(frames.size() == of_frames ? text : "frame " + std::to_string(frames.front()) + more + text);
        }
        return list;
    }
};

/// What must be the same in all frames.
std::string layout_of(const HostGBuffer& g) {
    const std::vector<std::string> formats{"d32f", "d24", "d16"};  // of DepthFormat
    return std::to_string(g.extent().x) + "x" + std::to_string(g.extent().y) + ", " + formats[size_t(g.depth_format)] +
           (g.camera.depth.w == 1 ? ", reversed depth" : ", standard depth") +
           (g.camera.frame.z == 1 ? ", orthographic" : ", perspective");
}

/// What a file says of the frame before must be that frame.
void check_predecessor(const fs::path& place, const LoadedGBuffer& now, const HostGBuffer& before, unsigned frame) {
    const CameraData& c = now.gbuffer.camera;
    if (c.frame.w == 1 && (differ(c.previous_view_from_world, before.camera.view_from_world) ||
                           differ(c.previous_clip_from_world, before.camera.clip_from_world)))
        fail((place / "camera.json").string(), ": its previous camera is not that of frame ", frame,
             ", so frames between them are missing, or it is that of another frame");
    if (now.absent.contains("previous_depth")) return;
    const HostImage stored = surface_distances(before, now.gbuffer.previous_depth);
    const HostImage& depth = before.depth;
    const double share =
        share_that_differs(stored, [&](size_t i) { return surface_distance(before, depth.values[i]); });
    if (share > 0.25)  // what is not drawn alike twice: foliage, particles, edges under another jitter
        fail((place / "gbuffer.exr").string(), ": previous_depth is not the depth of frame ", frame, ": ",
             std::lround(100 * share), " % of the pixels differ by more than 1 %");
}

/// What is taken in place of a layer that frames of a sequence lack.
std::string default_of(const std::string& layer, const std::string& of_single_frame, bool has_predecessor) {
    if (layer.starts_with("previous_")) return "";  // the frame played before has it
    if (layer == "motion" && has_predecessor)
        return "it is derived from depth and cameras, so that no object moves by itself";
    return of_single_frame;
}

void add_pixel_facts(const HostGBuffer& g, SceneFacts& facts) {
    facts.has_faulty_inputs |= !count_non_finite(g).empty();
    for (size_t i = 0; i < g.depth.values.size(); ++i) {
        if (is_background(g, i)) continue;
        facts.has_geometry = true;
        const glm::vec3 normal = g.normal.rgb(i);
        facts.has_faulty_inputs |= std::abs(glm::dot(normal, normal) - 1.0f) > 0.002f;  // as repair_image.frag
        const float roughness = g.normal.values[i * 4 + 3];
        const float specular = std::max(g.base_color.values[i * 4 + 3], g.emission.values[i * 4 + 3]);
        facts.has_matte |= !is_stored_as_reflective(specular);
        if (specular <= 0.0f) continue;
        facts.has_reflective = true;
        facts.min_roughness = std::min(facts.min_roughness, roughness),
        facts.max_roughness = std::max(facts.max_roughness, roughness);
    }
}

}  // namespace

Capture::Capture(const fs::path& folder) {
    folders_ = capture_frames(folder);
    for (const auto& [frame, path] : folders_) frames_.push_back(frame);
    environment_ = load_environment(folder, environment_notes_);
}

std::optional<unsigned> Capture::recorded_before(unsigned frame) const {
    const auto found = std::ranges::find(frames_, frame);
    if (found == frames_.begin() || found == frames_.end() || *(found - 1) + 1 != frame) return {};
    return *(found - 1);
}

const LoadedGBuffer& Capture::load(unsigned frame) {
    if (const auto found = loaded_.find(frame); found != loaded_.end()) return *found->second;
    auto loaded = std::make_unique<LoadedGBuffer>(load_gbuffer(folder_of(frame)));
    HostGBuffer& g = loaded->gbuffer;
    if (environment_ && loaded->absent.erase("fallback") > 0) {
        if (!prefiltered_) prefiltered_ = prefilter_environment(*environment_);
        g.fallback = HostImage(g.extent(), 4);
        for (size_t i = 0; i < g.depth.pixel_count(); ++i) {
            if (is_background(g, i)) continue;
            const glm::vec3 mirrored = glm::reflect(glm::vec3(view_direction(g, i)), g.normal.rgb(i));
            g.fallback.set_rgb(i, mean_over_lobe(*environment_, *prefiltered_, mirrored, g.normal.values[4 * i + 3]));
        }
    }
    constexpr size_t bytes_per_pixel = 132;  // of the images of HostGBuffer
    const size_t most = std::max<size_t>(2, max_loaded_bytes / (bytes_per_pixel * g.depth.pixel_count()));
    if (loaded_order_.size() >= most) {
        loaded_.erase(loaded_order_.front());
        loaded_order_.erase(loaded_order_.begin());
    }
    loaded_order_.push_back(frame);
    return *(loaded_[frame] = std::move(loaded));
}

HostGBuffer Capture::played(unsigned frame, std::optional<unsigned> previous) {
    const LoadedGBuffer& now = load(frame);
    HostGBuffer g = now.gbuffer;
    const bool is_given = previous && previous == recorded_before(frame) && !now.absent.contains("motion");
    const HostGBuffer& before = previous && previous != frame ? load(*previous).gbuffer : g;
    CameraData& c = g.camera;
    c.frame.w = previous.has_value();
    c.previous_clip_from_world = before.camera.clip_from_world;
    c.previous_view_from_world = before.camera.view_from_world;
    c.previous_world_from_view = before.camera.world_from_view;
    c.previous_view_from_clip = before.camera.view_from_clip;
    c.jitter.z = before.camera.jitter.x, c.jitter.w = before.camera.jitter.y;
    g.previous_depth = before.depth;
    g.previous_normal = before.normal;
    if (!previous || previous == frame)
        g.motion = HostImage(g.extent(), 2);
    else if (!is_given)
        g.motion = camera_motion(g, before.camera);
    return g;
}

Shot capture_shot(const ShotConfig& config, const Capture& capture) {
    for (size_t i = 0; i < config.frames.size(); ++i) {
        const unsigned frame = config.frames[i];
        if (std::ranges::find(capture.frames(), frame) == capture.frames().end())
            fail(config.gbuffer.string(), ": frame ", frame, " is missing; there are ", capture.frames().size(),
                 " frames from ", capture.frames().front(), " to ", capture.frames().back());
        if (i > 0 && frame != config.frames[i - 1] + 1)
            fail(config.gbuffer.string(), ": frame ", config.frames[i - 1], " is followed by ", frame,
                 ", but its motion vectors are those since the frame before it; name 'frames' without gaps");
    }
    Shot shot{
        .config = config, .scene = {}, .camera = {.name = camera_of_captures}, .facts = {}, .steps = timeline(config)};
    shot.scene.name = capture_name(config.gbuffer);
    const CameraFile camera = read_camera(path_inside(capture.folder_of(config.frames.front()), "camera.json"));
    shot.config.extent = glm::uvec2(camera.camera.extent);
    shot.camera.exposure_ev = camera.exposure_ev;
    ContentHash hash;
    const auto add = [&](const fs::path& file) {
        std::error_code error;
        if (fs::exists(file, error)) hash.add(read_text(file));
    };
    for (const unsigned frame : config.frames)
        for (const char* file : {"gbuffer.exr", "camera.json"}) add(path_inside(capture.folder_of(frame), file));
    for (const char* file : {"environment.json", "environment.exr"}) add(path_inside(config.gbuffer, file));
    shot.scene.content_hash = hash.hex();
    return shot;
}

CaptureContents inspect_capture(const Shot& shot, Capture& capture) {
    CaptureContents contents;
    SceneFacts& facts = contents.facts;
    facts.camera_moves = facts.objects_move = facts.has_environment = true;
    facts.has_matte = false;
    FrameNotes notes;
    std::string layout;
    const unsigned first = shot.config.frames.front();
    for (const unsigned frame : shot.config.frames) {
        const fs::path place = capture.folder_of(frame);
        const LoadedGBuffer now = capture.load(frame);
        if (frame == first) layout = layout_of(now.gbuffer), contents.layers = now.layers;
        if (layout_of(now.gbuffer) != layout)
            fail(place.string(), " is ", layout_of(now.gbuffer), ", but the first frame is ", layout);
        const bool has_lit = !now.absent.contains("lit");
        if (frame != first && has_lit != contents.has_lit)
            fail((place / "gbuffer.exr").string(), has_lit ? " has" : " lacks",
                 " the layer 'lit', which the first frame ", has_lit ? "lacks" : "has");
        contents.has_lit = has_lit;
        add_pixel_facts(now.gbuffer, facts);
        facts.has_matte |= facts.has_faulty_inputs;  // what is repaired has no specular term
        for (const auto& [layer, text] : now.absent)
            if (const std::string taken = default_of(layer, text, shot.config.frames.size() > 1); !taken.empty())
                notes.add("There is no layer '" + layer + "': " + taken + ".", frame);
        for (const std::string& note : now.notes) notes.add(note, frame);
        if (frame == first) continue;
        const HostGBuffer& before = capture.load(frame - 1).gbuffer;
        check_predecessor(place, now, before, frame - 1);
        if (!now.absent.contains("motion"))
            for (const std::string& note : check_motion(before, now.gbuffer)) notes.add(note, frame);
    }
    contents.notes = notes.texts(shot.config.frames.size());
    std::ranges::copy(capture.environment_notes(), std::back_inserter(contents.notes));
    return contents;
}

fs::path capture_reference_file(const ShotConfig& config, unsigned frame) {
    const auto name = numbered_name(config.reference.string(), frame, config.reference_pattern_at);
    if (std::error_code error; !name || fs::exists(config.reference, error)) return config.reference;
    return *name;
}

Reference read_capture_reference(const Shot& shot, Capture& capture, unsigned frame, bool needs_ladder) {
    const fs::path file = capture_reference_file(shot.config, frame);
    Reference reference = read_reference(file);
    if (needs_ladder && reference.ladder.is_empty())
        fail(file.string(),
             " has no truth ladder, which the targets 'camera_radiance' and 'on_screen' need; render it ",
             "with `ssrlab reference --ladder`, or leave them out of 'targets'");
    for (const unsigned other : shot.config.frames) {
        if (capture_reference_file(shot.config, other) != file) continue;
        const HostGBuffer& gbuffer = capture.load(other).gbuffer;
        if (reference.extent != gbuffer.extent())
            fail(file.string(), " is ", reference.extent.x, "x", reference.extent.y, ", but the G-buffer is ",
                 gbuffer.extent().x, "x", gbuffer.extent().y);
        // A rasteriser and a ray tracer disagree in some pixels of edges and foliage; another camera changes nearly
        // all.
        const double share = share_that_differs(
            reference.depth, [&](size_t i) { return surface_distance(gbuffer, gbuffer.depth.values[i]); });
        if (share > 0.25)
            fail(file.string(), " does not belong to the G-buffer in ", capture.folder_of(other).string(),
                 ": the depths of ", std::lround(100 * share),
                 " % of their pixels differ by more than 1 %, so it was made with another camera, frame or scene");
    }
    return reference;
}
