#include "experiments/study/shots/point_rays.h"

#include <algorithm>

namespace {

/// What `specular` is compared with; null where it is not measured.
const MetricReference* specular_reference(const PoseTruth& pose) {
    const auto found = pose.targets.find("specular");
    return found != pose.targets.end() ? &found->second : pose.frame_reference ? &*pose.frame_reference : nullptr;
}

}  // namespace

void PointRays::plug_in_scene(RayProbe& probe, PassList& pass_list, const FrameStep& step, const CameraData& camera,
                              const GBuffer& gbuffer, unsigned seed) {
    if (!point_.shot.config.gbuffer.empty()) return;
    probe.exact_hits = [this, &step, camera](const RecordedRays& recorded) {
        return rays_in_scene(step, camera).hits(recorded);
    };
    answered_.reset();
    probe.answers = [this, &pass_list, &step, camera, gbuffer, seed](const RecordedRays& marched,
                                                                     const AskedRays& asked) {
        if (!answered_) {
            AnsweredRays::Frame frame{.lit = pass_list.download(gbuffer.lit),
                                      .fallback = pass_list.download(gbuffer.fallback),
                                      .normal = pass_list.download(gbuffer.normal),
                                      .index = step.index,
                                      .seed = seed};
            if (const FrameTruth* truth = point_.truth.frame(step)) {
                frame.reflectance = truth->reflectance;
                // The guide's samples are in neither half of the reference that errors are measured against.
                if (const MetricReference* specular = specular_reference(*truth->pose); specular && specular->halves)
                    frame.true_specular = specular->halves->guide;
            }
            answered_.emplace(std::move(frame));
        }
        return answered_->choose(marched, rays_in_scene(step, camera).hits(marched), asked);
    };
}

bool PointRays::judges(unsigned seed, const FrameStep& step) const {
    const std::vector<unsigned>& seeds = point_.technique.seeds;
    if (!point_.technique.depends_on_seed && seed != seeds.front()) return false;  // it would trace the same rays
    return point_.config.hits && step.is_measured && point_.shot.config.gbuffer.empty() &&
           size_t(std::ranges::find(seeds, seed) - seeds.begin()) < point_.config.hits->seeds;
}

std::vector<PointRays::VerdictMap> PointRays::judge(unsigned seed, const std::vector<RecordedRays>& recorded,
                                                    const FrameStep& step, const CameraData& camera,
                                                    const HostImage& specular, std::span<const Mask> masks,
                                                    bool has_maps) {
    const FrameTruth* frame_truth = point_.truth.frame(step);
    const MetricReference* reference = frame_truth ? specular_reference(*frame_truth->pose) : nullptr;
    const unsigned every = point_.config.hits->every;
    const bool has_causes = reference && every == 1;  // neighbours' rays are needed
    const glm::uvec2 extent = point_.shot.config.extent;
    std::vector<VerdictMap> maps;
    for (const RecordedRays& rays : recorded) {
        const std::vector<ExactHit> truth = rays_in_scene(step, camera).hits(rays, every);
        judged_[step.frame].add(seed, rays, truth, extent, every, {masks.begin(), masks.end()});
        if (has_causes) causes_[step.frame].add(rays, truth, extent);
        if (has_maps && every == 1) maps.push_back({rays.stage, map_of_verdicts(rays, truth, extent)});
    }
    if (has_causes) causes_[step.frame].finish(*reference, specular, {masks.begin(), masks.end()});
    return maps;
}

std::vector<HitRow> PointRays::rows() const {
    std::vector<HitRow> all;
    for (const auto& [frame, judged] : judged_) {
        const HitRow shared{.shot = point_.shot.name(),
                            .frame = std::to_string(frame),
                            .technique = point_.technique.technique,
                            .point = point_.technique.point,
                            .stage = {},
                            .mask = {},
                            .quantity = {},
                            .low = {},
                            .high = {}};
        for (HitRow& row : judged.rows(shared)) all.push_back(std::move(row));
        if (const auto causes = causes_.find(frame); causes != causes_.end())
            for (HitRow& row : causes->second.rows(shared)) all.push_back(std::move(row));
    }
    return all;
}
