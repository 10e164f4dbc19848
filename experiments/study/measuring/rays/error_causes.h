#pragma once
#include "experiments/study/measuring/rays/judged_hits.h"
#include "metrics/score.h"

/// HitRow::stage of the rows below: no pass, but the error of the whole technique.
inline const std::string error_stage = "error";

/// Where the squared error of a result lies, by what became of the rays of its pixels: which of it is the march's,
/// which lies where the screen does not show what is reflected, and which is left where the ray was right (drawing,
/// filters, fallback, what depends on the view). An attribution by place: a filter carries errors to neighbours.
///
/// A pixel's rays are those of the last pass that traced any for it; a pixel without one is read as the first of its
/// 2 x 2 pixels that has one, since techniques share rays within these.
class ErrorCauses {
public:
    /// The rays of one pass, and what each of them truly meets, of the frame and seed that finish() ends. Passes in
    /// their order.
    void add(const RecordedRays& recorded, const std::vector<ExactHit>& truth, glm::uvec2 extent);

    /// `tested`: what is compared with `reference`. Where that has two halves, A and B, an error is (x - A)(x - B),
    /// free of the reference's noise. Pixels that are not finite do not count.
    void finish(const MetricReference& reference, const HostImage& tested, const std::vector<Mask>& masks);

    /// `shared`: shot, frame, technique and point. Quantities: "error: " and a name of ray_verdict_names(), or
    /// "error: untraced"; as shares of the whole error, which add up to 1. A share may come out below 0, where noise
    /// was taken off. Means over the seeds with Student's interval; none with a single seed. A mask without an error
    /// above 0 has no rows.
    std::vector<HitRow> rows(const HitRow& shared) const;

private:
    static constexpr size_t cause_count = ray_verdict_count + 1;  ///< the last one: no ray
    using Shares = std::array<double, cause_count>;
    struct SeedShares {
        size_t pixels;  ///< that count
        Shares shares;
    };

    std::vector<VerdictSums> of_pixel_;  ///< of the frame and seed that are being added: over the rays of each
    std::vector<std::pair<std::string, std::vector<SeedShares>>> by_mask_;

    size_t pixel_with_rays(size_t pixel, glm::uvec2 extent) const;
};
