#include "experiments/stability/case_frames.h"

#include "core/error.h"
#include "core/gbuffer/composite.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/near_miss.h"
#include "experiments/stability/changed_scene.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace {

/// Enough that the truth's own noise is small beside a technique's error: a ratio of errors is what it decides.
constexpr unsigned samples = 64;
constexpr float least_reflectance = 0.02f;  // as the mask `reflective`

HostImage& image_of(HostGBuffer& g, const std::string& name) {
    const std::vector<std::pair<std::string, HostImage*>> images = {{"depth", &g.depth},
                                                                    {"geometric_normal", &g.geometric_normal},
                                                                    {"normal", &g.normal},
                                                                    {"base_color", &g.base_color},
                                                                    {"emission", &g.emission},
                                                                    {"motion", &g.motion},
                                                                    {"previous_depth", &g.previous_depth},
                                                                    {"previous_normal", &g.previous_normal},
                                                                    {"lit", &g.lit},
                                                                    {"fallback", &g.fallback}};
    std::vector<std::string> names;
    for (const auto& [known, image] : images) {
        if (known == name) return *image;
        names.push_back(known);
    }
    fail("a case's fault is of the unknown image '", name, "'", suggestion(name, names));
}

bool is_hit(const InputFault& fault, glm::uvec2 pixel, glm::uvec2 extent) {
    if (fault.where == "all") return true;
    if (fault.where == "every_other") return (pixel.x + pixel.y) % 2 == 1;
    return pixel == min(glm::uvec2(fault.at * glm::vec2(extent)), extent - 1u);
}

void apply(const InputFault& fault, HostGBuffer& gbuffer) {
    HostImage& image = image_of(gbuffer, fault.image);
    for (unsigned y = 0; y < image.extent.y; ++y)
        for (unsigned x = 0; x < image.extent.x; ++x) {
            if (!is_hit(fault, {x, y}, image.extent)) continue;
            for (unsigned c = 0; c < image.channels && c < std::max<size_t>(fault.value.size(), 3); ++c) {
                const float value = fault.value[std::min<size_t>(c, fault.value.size() - 1)];
                float& texel = image.pixel(x, y)[c];
                texel = fault.is_factor ? texel * value : value;
            }
        }
}

/// What is wrong with depth or normal of one frame is wrong with what the next one has of it.
std::vector<InputFault> with_aftermath(const std::vector<InputFault>& faults) {
    std::vector<InputFault> all = faults;
    for (InputFault fault : faults) {
        if (fault.image != "depth" && fault.image != "normal") continue;
        fault.image = "previous_" + fault.image;
        if (fault.step) ++*fault.step;
        all.push_back(fault);
    }
    return all;
}

bool is_finite_pixel(const HostImage& image, size_t pixel) {
    return std::all_of(&image.values[pixel * image.channels], &image.values[pixel * image.channels] + image.channels,
                       [](float value) { return std::isfinite(value); });
}

}  // namespace

bool is_sound(const HostGBuffer& g, size_t pixel) {
    for (const HostImage* image : {&g.depth, &g.geometric_normal, &g.normal, &g.base_color, &g.emission, &g.motion,
                                   &g.previous_depth, &g.previous_normal, &g.lit, &g.fallback})
        if (!is_finite_pixel(*image, pixel)) return false;
    return true;
}

std::shared_ptr<const Reference> TruthStore::get(const Scene& scene, const SceneCamera& camera, glm::uvec2 size,
                                                 unsigned pose) {
    const ScenePose scene_pose = pose_scene(scene, float(pose));
    const CameraPose camera_pose = pose_camera(camera, scene_pose, float(pose));
    const ReferenceSettings settings{.max_samples = samples};
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const Reference>& known = known_[reference_stream(scene, scene_pose, camera_pose, size, settings)];
    if (!known) known = std::make_shared<Reference>(render_reference(scene, scene_pose, camera_pose, size, settings));
    return known;
}

CaseFrames CaseDrawer::draw(const CaseScene& wanted, const std::vector<InputFault>& own_faults,
                            const std::function<void(HostGBuffer&)>& perturbation) {
    const std::vector<InputFault> faults = with_aftermath(own_faults);
    struct Drawn {
        ChangedScene changed;
        std::unique_ptr<Rasterizer> rasterizer;
    };
    const auto drawn = std::make_shared<Drawn>(Drawn{changed_scene(wanted, search_path_), nullptr});
    const auto& [scene, camera] = drawn->changed;
    drawn->rasterizer = std::make_unique<Rasterizer>(
        device_, scene,
        RasterizerOptions{.extent = wanted.size, .depth_format = wanted.depth_format, .has_depth_layers = true});
    CaseFrames frames;
    frames.owners.push_back(drawn);

    using Look = std::tuple<unsigned, std::optional<unsigned>, std::vector<bool>>;  // pose, pose before, faults
    std::map<Look, CaseFrame> known;
    for (unsigned step = 0; step < wanted.poses.size(); ++step) {
        const unsigned pose = wanted.poses[step];
        const std::optional<unsigned> before = step ? std::optional(wanted.poses[step - 1]) : std::nullopt;
        std::vector<bool> has_fault;
        for (const InputFault& fault : faults) has_fault.push_back(fault.step.value_or(step) == step);
        const auto [entry, is_new] = known.try_emplace({pose, before, has_fault});
        CaseFrame& frame = entry->second;
        if (is_new) {
            const std::shared_ptr<const Reference> truth =
                wanted.is_lit_directly ? nullptr : truths_.get(scene, camera, wanted.size, pose);
            Rasterizer& rasterizer = *drawn->rasterizer;
            const GBuffer gbuffer = rasterizer.render(camera, {.extent = wanted.size,
                                                               .depth_direction = wanted.depth_direction,
                                                               .frame = pose,
                                                               .seed = 1,
                                                               .index = step,
                                                               .previous_frame = before});
            if (truth)
                rasterizer.upload_lit(gbuffer, truth->diffuse.mean);
            else
                rasterizer.light_directly(gbuffer);
            HostGBuffer host = download_gbuffer(rasterizer.graph(), gbuffer, rasterizer.camera(), wanted.depth_format);
            for (size_t i = 0; i < faults.size(); ++i)
                if (has_fault[i]) apply(faults[i], host);
            if (perturbation) perturbation(host);
            const auto graph = std::make_shared<PassGraph>(device_, wanted.size);
            frame = {.host = std::make_shared<HostGBuffer>(host),
                     .gbuffer = upload_gbuffer(*graph, host),
                     .camera = host.camera};
            frame.gbuffer.environment = gbuffer.environment;
            frames.owners.push_back(graph);
            if (step + 1 == wanted.poses.size()) frames.reference = truth;
        }
        frames.steps.push_back(frame);
        frames.steps.back().camera.frame.x = step;
    }
    if (!frames.reference && !wanted.is_lit_directly)
        frames.reference = truths_.get(scene, camera, wanted.size, wanted.poses.back());
    if (frames.reference) frames.truth = frames.reference->specular.mean;

    const HostGBuffer& last = *frames.steps.back().host;
    const HostImage reflectance = specular_reflectance(last);
    for (size_t i = 0; i < last.depth.pixel_count(); ++i) {
        const glm::vec3 r = reflectance.rgb(i);
        frames.is_sound.push_back(is_sound(last, i));
        frames.is_judged.push_back(frames.is_sound.back() && last.material_id.values[i] != 0 &&
                                   std::max({r.x, r.y, r.z}) >= least_reflectance);
    }
    return frames;
}
