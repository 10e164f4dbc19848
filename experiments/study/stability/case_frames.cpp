#include "experiments/study/stability/case_frames.h"

#include "core/gbuffer/composite.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "experiments/study/stability/changed_shot.h"
#include "groundtruth/reference/reference_cache.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace {

/// Enough that the truth's own noise is small beside a technique's error: a ratio of errors is what it decides.
constexpr unsigned samples = 64;
constexpr float least_reflectance = 0.02f;  // as the mask `reflective`

bool is_hit(const InputFault& fault, glm::uvec2 pixel, glm::uvec2 extent) {
    if (fault.where == "all") return true;
    if (fault.where == "every_other") return (pixel.x + pixel.y) % 2 == 1;
    return pixel == min(glm::uvec2(fault.at * glm::vec2(extent)), extent - 1u);
}

void apply(const InputFault& fault, HostGBuffer& gbuffer) {
    HostImage& image = gbuffer.*fault.image;
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
        if (fault.image != &HostGBuffer::depth && fault.image != &HostGBuffer::normal) continue;
        fault.image = fault.image == &HostGBuffer::depth ? &HostGBuffer::previous_depth : &HostGBuffer::previous_normal;
        if (fault.step) ++*fault.step;
        all.push_back(fault);
    }
    return all;
}

}  // namespace

bool is_sound(const HostGBuffer& g, size_t pixel) {
    return std::ranges::all_of(input_images(), [&](const auto& named) {
        const HostImage& image = g.*named.second;
        const float* const texel = &image.values[pixel * image.channels];
        return std::all_of(texel, texel + image.channels, [](float value) { return std::isfinite(value); });
    });
}

CaseDrawer::CaseDrawer(Device& device, std::vector<std::filesystem::path> search_path, std::filesystem::path cache,
                       const std::vector<PointConfig>& points)
    : device_(device), search_path_(std::move(search_path)), cache_(std::move(cache)) {
    config_.techniques = points;
    config_.reference.max_samples = samples;
}

CaseFrames CaseDrawer::draw(const CaseScene& wanted, const std::vector<InputFault>& own_faults,
                            const std::function<void(HostGBuffer&)>& perturbation) {
    const std::vector<InputFault> faults = with_aftermath(own_faults);
    const auto shot = std::make_shared<const Shot>(changed_shot(wanted, search_path_));
    const std::shared_ptr<FrameSource> source = scene_source(device_, *shot, config_, false);
    CaseFrames frames;
    frames.shot = shot, frames.owners.push_back(source);
    std::map<unsigned, std::shared_ptr<const Reference>> references;  // by pose
    const auto reference_of = [&](unsigned pose) {
        std::shared_ptr<const Reference>& known = references[pose];
        if (known || shot->config.direct_lit) return known;
        const ShotFrame now = shot_frame(*shot, pose);
        known = std::make_shared<Reference>(
            cached_reference(shot->scene, now.scene, now.camera, shot->config.extent, config_.reference, cache_));
        return known;
    };

    using Look = std::tuple<unsigned, std::optional<unsigned>, std::vector<bool>>;  // pose, pose before, faults
    std::map<Look, CaseFrame> known;
    for (const FrameStep& step : shot->steps) {
        std::vector<bool> has_fault;
        for (const InputFault& fault : faults) has_fault.push_back(fault.step.value_or(step.index) == step.index);
        const auto [entry, is_new] = known.try_emplace({step.frame, step.previous_frame, has_fault});
        CaseFrame& frame = entry->second;
        if (is_new) {
            const std::shared_ptr<const Reference> reference = reference_of(step.frame);
            const GBuffer gbuffer = source->render(step, 0, reference ? reference->diffuse.mean : HostImage());
            HostGBuffer host =
                download_gbuffer(source->pass_list(), gbuffer, source->camera(), shot->config.depth_format);
            for (size_t i = 0; i < faults.size(); ++i)
                if (has_fault[i]) apply(faults[i], host);
            if (perturbation) perturbation(host);
            const auto pass_list = std::make_shared<PassList>(device_, shot->config.extent);
            frame = {.host = std::make_shared<HostGBuffer>(host),
                     .gbuffer = upload_gbuffer(*pass_list, host),
                     .camera = host.camera};
            frame.gbuffer.environment = gbuffer.environment;
            frames.owners.push_back(pass_list);
        }
        frames.steps.push_back(frame);
        frames.steps.back().camera.frame.x = step.index;
    }
    frames.reference = reference_of(shot->steps.back().frame);
    if (frames.reference) frames.truth = frames.reference->specular.mean;

    const HostGBuffer& last = *frames.steps.back().host;
    const HostImage reflectance = specular_reflectance(last);
    for (size_t i = 0; i < last.depth.pixel_count(); ++i) {
        const glm::vec3 r = reflectance.rgb(i);
        frames.is_judged.push_back(is_sound(last, i) && last.material_id.values[i] != 0 &&
                                   std::max({r.x, r.y, r.z}) >= least_reflectance);
    }
    return frames;
}
