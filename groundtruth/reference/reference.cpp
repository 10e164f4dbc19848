#include "groundtruth/reference/reference.h"

#include "core/digits.h"
#include "core/error.h"
#include "core/files.h"
#include "groundtruth/code_version.h"
#include "groundtruth/paths/path_tracer.h"
#include "groundtruth/reference/adaptive_directions.h"
#include "groundtruth/reference/platform.h"
#include "groundtruth/reference/reference_guide.h"
#include "groundtruth/reference/reference_stopping.h"

#include <algorithm>
#include <charconv>

namespace {

void add(ContentHash& hash, const glm::mat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) hash.add(matrix[column][row]);
}

void add(ContentHash& hash, glm::vec3 v) {
    for (int i = 0; i < 3; ++i) hash.add(v[i]);
}

void add(ContentHash& hash, const ScenePose& pose) {
    hash.add(pose.world_from_instance.size());
    for (const glm::mat4& matrix : pose.world_from_instance) add(hash, matrix);
    for (const Deformation& deformation : pose.deformations) {  // none where all meshes keep their shapes
        hash.add(deformation.instance_from_mesh.size());
        for (const glm::mat4& matrix : deformation.instance_from_mesh) add(hash, matrix);
        hash.add(deformation.weights.size());
        for (const float weight : deformation.weights) hash.add(weight);
    }
    hash.add(pose.lights.size());
    for (const PunctualLight& light : pose.lights) {
        hash.add(int(light.type));
        for (const glm::vec3 v : {light.intensity, light.position, light.direction}) add(hash, v);
        for (const float f : {light.range, light.inner_cone_cos, light.outer_cone_cos}) hash.add(f);
    }
}

/// Planes are part of it, cut they or not: who moves them asks for another picture.
void add(ContentHash& hash, const CameraPose& unfitted, glm::uvec2 extent) {
    const CameraPose camera = fitted(unfitted, double(extent.x) / extent.y);
    add(hash, camera.world_from_view);
    hash.add(int(camera.is_orthographic));
    for (const float f : {camera.vertical_fov, camera.orthographic_height, camera.near, camera.far}) hash.add(f);
}

void check(glm::uvec2 extent, const ReferenceSettings& settings) {
    constexpr unsigned max_size = 32768;
    if (extent.x == 0 || extent.y == 0 || extent.x > max_size || extent.y > max_size)
        fail("a reference of ", extent.x, " x ", extent.y, " pixels cannot be rendered: width and height must be 1 to ",
             max_size);
    if (!(settings.max_seconds >= 0))
        fail("max_seconds of a reference is ", settings.max_seconds, ", but must not be negative");
    if (!(settings.target_relative_error >= 0 && settings.target_relative_error <= 1))
        fail("target_relative_error of a reference is ", settings.target_relative_error,
             ", but must be within 0 and 1");
    if (!(settings.adaptive_share >= 0 && settings.adaptive_share <= ReferenceSettings::most_adaptive_share))
        fail("adaptive_share of a reference is ", settings.adaptive_share, ", but must be within 0 and ",
             ReferenceSettings::most_adaptive_share);
    if (settings.adaptive_share > 0 && (settings.lit_only || settings.target_relative_error > 0))
        fail("a reference with an adaptive_share has no target, and is not of the lit colour alone");
    if (settings.max_samples > max_sample_limit)
        fail("max_samples of a reference is ", settings.max_samples, ", but can be ", max_sample_limit, " at most");
    if (settings.lit_only && (settings.ladder || settings.target_relative_error > 0))
        fail("a reference of the lit colour alone has no truth ladder and no target, which are of the specular light");
    if (settings.lit_samples > max_sample_limit)
        fail("lit_samples of a reference is ", settings.lit_samples, ", but can be ", max_sample_limit, " at most");
    if (settings.lit_only && settings.lit_samples > 0)
        fail("lit_samples of a reference of the lit colour alone are its max_samples");
    if (settings.guide_samples == 0 || settings.guide_samples > max_sample_limit)
        fail("guide_samples of a reference is ", settings.guide_samples, ", but must be 1 to ", max_sample_limit);
    if (settings.max_depth == 0) fail("max_depth of a reference is 0, but must be at least 1");
}

/// The state that the file holds of this request, or an empty one.
ReferenceState pick_up(const ReferenceRun& run, const std::string& stream, glm::uvec2 extent,
                       const ReferenceSettings& settings) {
    if (!run.state_file.empty() && std::filesystem::exists(run.state_file)) try {
            ReferenceState found = read_reference_state(run.state_file);
            const bool is_unfinished = !found.sample_goal.values.empty();
            const bool is_same = found.reference.hash == reference_key(stream, settings);
            if (!is_unfinished) found.level = uint64_t(std::ranges::max(found.reference.sample_count.values));
            if (found.reference.stream == stream && found.reference.extent == extent &&
                (is_unfinished ? is_same : can_be_extended(found.settings, settings)))
                return found;
        } catch (const MachineError&) {
            throw;
        } catch (const Error& error) {
            if (run.notice) run.notice(std::string(error.what()) + "; the reference is rendered anew");
        }
    return empty_state(extent, settings);
}

}  // namespace

std::string groundtruth_code_version() { return std::string(code_version); }

std::string reference_request(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                              const ReferenceSettings& settings) {
    if (scene.content_hash.empty())
        fail("the scene '", scene.name, "' has no content hash, so its reference cannot be identified");
    ContentHash hash;
    hash.add(scene.content_hash);
    add(hash, pose);
    add(hash, camera, extent);
    for (const unsigned value :
         {extent.x, extent.y, settings.max_depth, settings.seed, unsigned(settings.ladder), unsigned(settings.lit_only),
          unsigned(settings.keep_all), unsigned(lit_sample_limit(settings)),
          unsigned(settings.adaptive_share > 0 && settings.adaptive_image),
          settings.lit_only ? 0u : unsigned(rounded_samples(settings.guide_samples))})
        hash.add(value);
    hash.add(settings.adaptive_share);
    return hash.hex();
}

std::string reference_stream(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                             const ReferenceSettings& settings) {
    ContentHash hash;
    for (const std::string& part :
         {std::string(code_version), render_platform(), reference_request(scene, pose, camera, extent, settings)})
        hash.add(part);
    return hash.hex();
}

std::string reference_key(const std::string& stream, const ReferenceSettings& settings) {
    std::string key = stream + "-n" + shortest_digits(sample_limit(settings));
    if (settings.target_relative_error > 0) key += "-e" + shortest_digits(settings.target_relative_error);
    if (settings.max_seconds > 0) key += "-t" + shortest_digits(settings.max_seconds);
    return key;
}

std::optional<ReferenceSettings> settings_of_key(const std::string& stream, const std::string& key) {
    if (!key.starts_with(stream + "-n")) return {};
    ReferenceSettings settings;
    const char *at = key.data() + stream.size(), *end = key.data() + key.size();
    const auto read = [&](const char* sign, auto& value) {
        if (!std::string_view(at, end).starts_with(sign)) return;
        at = std::from_chars(at + 2, end, value).ptr;
    };
    read("-n", settings.max_samples);
    read("-e", settings.target_relative_error);
    read("-t", settings.max_seconds);
    return at == end && reference_key(stream, settings) == key ? std::optional(settings) : std::nullopt;
}

Reference render_reference(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                           const ReferenceSettings& settings, const ReferenceRun& run) {
    check(extent, settings);
    const std::string stream = reference_stream(scene, pose, camera, extent, settings);
    ReferenceState state = pick_up(run, stream, extent, settings);
    state.settings = settings;
    state.reference.stream = stream;
    state.reference.hash = reference_key(stream, settings);

    PathTracer path_tracer(scene, pose, camera, extent,
                           {.max_depth = settings.max_depth,
                            .specular = !settings.lit_only,
                            .ladder = settings.ladder,
                            .keep_all = settings.keep_all});
    const PixelTracer tracer = pixel_tracer(path_tracer);
    const bool needs_guide_variance = settings.target_relative_error > 0 && state.guide_variance.values.empty();
    const bool needs_directions = settings.adaptive_share > 0 && state.reference.directions.values.empty();
    // Of the lit colour alone few samples are asked, and a guide would take more than roulette by it saves.
    if (!settings.lit_only) {
        if (state.reference.guide.specular.values.empty() || needs_guide_variance || needs_directions) {
            RenderedGuide guide = render_guide(tracer, extent, unsigned(rounded_samples(settings.guide_samples)), run);
            if (needs_directions)
                state.reference.directions =
                    adaptive_directions(guide, settings.adaptive_share, settings.adaptive_image);
            state.reference.guide = std::move(guide.means);
            if (needs_guide_variance) state.guide_variance = std::move(guide.specular_variance);
        }
        tracer.expect(state.reference.guide.diffuse, state.reference.guide.specular);
    }

    RenderClock clock{.run = run, .seconds_before = state.reference.seconds, .rays_before = state.reference.rays};
    render_until_limits(state, tracer, clock);
    return std::move(state.reference);
}
