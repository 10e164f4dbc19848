#pragma once
#include "core/gbuffer/gbuffer.h"
#include "experiments/study/measuring/rays/answered_rays.h"
#include "experiments/study/measuring/rays/error_causes.h"
#include "experiments/study/measuring/rays/exact_rays.h"
#include "experiments/study/measuring/rays/judged_hits.h"
#include "experiments/study/shots/point_in_shot.h"

/// A point's recorded rays compared with their true hits in the scene, over the seeds whose rays the study judges.
class PointRays {
public:
    explicit PointRays(const PointInShot& point) : point_(point) {}

    /// Answers requests for scene data in this step, in which `seed` is rendered from `gbuffer`. Does nothing for a
    /// capture, which has no scene.
    void plug_in_scene(RayProbe& probe, PassList& pass_list, const FrameStep& step, const CameraData& camera,
                       const GBuffer& gbuffer, unsigned seed);
    bool judges(unsigned seed, const FrameStep& step) const;

    /// A picture of the verdicts on one stage's rays.
    struct VerdictMap {
        std::string stage;
        HostImage map;
    };
    /// Judges the recorded rays of a step, and the error of `specular` at their pixels. Returns pictures of the
    /// verdicts if `has_maps` and every pixel's rays are judged.
    std::vector<VerdictMap> judge(unsigned seed, const std::vector<RecordedRays>& recorded, const FrameStep& step,
                                  const CameraData& camera, const HostImage& specular, std::span<const Mask> masks,
                                  bool has_maps);
    std::vector<HitRow> rows() const;

private:
    const ExactRays& rays_in_scene(const FrameStep& step, const CameraData& camera) {
        return exact_.try_emplace(step.frame, point_.shot, step.frame, camera).first->second;
    }

    const PointInShot& point_;
    std::map<unsigned, ExactRays> exact_;     ///< by frame
    std::optional<AnsweredRays> answered_;    ///< of the current step
    std::map<unsigned, JudgedHits> judged_;   ///< by frame
    std::map<unsigned, ErrorCauses> causes_;  ///< by frame
};
