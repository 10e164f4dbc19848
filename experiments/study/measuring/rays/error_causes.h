#pragma once
#include "experiments/study/measuring/rays/judged_hits.h"
#include "metrics/score.h"

/// HitRow::stage of the rows below: not a pass, but the error of the whole technique.
inline const std::string error_stage = "error";

/// Splits the squared error of a result by the verdicts on its pixels' rays. It shows which part belongs to the march,
/// which part lies where the screen does not show what is reflected, and which part is left where the ray was right
/// (sampling, filters, fallback, dependence on the view). Errors are attributed by place: a filter carries them to
/// neighbours.
///
/// A pixel's rays are those of the last pass that traced any for it. A pixel without rays uses the first pixel of its 2
/// x 2 block that has some, since techniques share rays within blocks.
class ErrorCauses {
public:
    /// Adds the rays of one pass, in the order of passes, with their true hits. They belong to the frame and seed that
    /// the next finish() ends.
    void add(const RecordedRays& recorded, const std::vector<ExactHit>& truth, glm::uvec2 extent);

    /// Ends a frame and seed. `tested` is compared with `reference`. Where the reference has two halves, A and B, an
    /// error is (x - A)(x - B), which is free of its noise. Pixels that are not finite do not count.
    void finish(const MetricReference& reference, const HostImage& tested, const std::vector<Mask>& masks);

    /// `shared`: shot, frame, technique and point. Quantities are "error: " and a name of ray_verdict_names(), or
    /// "error: untraced". Values are shares of the whole error and add up to 1; noise that was taken off may leave a
    /// share below 0. Values are means over the seeds with Student's interval; a single seed has no interval. A mask
    /// whose error is not above 0 has no rows.
    std::vector<HitRow> rows(const HitRow& shared) const;

private:
    static constexpr size_t cause_count = ray_verdict_count + 1;  ///< the last cause: no ray
    using Shares = std::array<double, cause_count>;
    struct SeedShares {
        size_t pixels;  ///< number of counted pixels
        Shares shares;
    };

    std::vector<VerdictSums> of_pixel_;  ///< by pixel, over its rays; of the current frame and seed
    std::vector<std::pair<std::string, std::vector<SeedShares>>> by_mask_;

    size_t pixel_with_rays(size_t pixel, glm::uvec2 extent) const;
};
