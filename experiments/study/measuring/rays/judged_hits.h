#pragma once
#include "core/host_image.h"
#include "core/ray_probe.h"
#include "experiments/results/cells/cell.h"
#include "metrics/masks.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// What became of a ray, by what it truly met and what its tracer says. A hit of confidence c counts as c of a hit and
/// 1 - c of a miss.
enum class RayVerdict {
    right,             ///< a visible point was met, within one pixel
    wrong_place,       ///< a visible point was met, and another place was taken for it
    false_hit,         ///< nothing visible was met, and something was taken for it
    avoidable_miss,    ///< a visible point was met, and missed
    unavoidable_miss,  ///< what was met is hidden, off the screen, or behind the camera; missed
    empty,             ///< it left the scene, or began below its surface; missed
};
inline constexpr size_t ray_verdict_count = 6;
const std::array<const char*, ray_verdict_count>& ray_verdict_names();

RayVerdict verdict_of_hit(const RayRecord& ray, const ExactHit& truth);
RayVerdict verdict_of_miss(const ExactHit& truth);

/// How much of each verdict; of one ray they add up to 1.
using VerdictSums = std::array<double, ray_verdict_count>;
void add_verdicts(VerdictSums& sums, const RayRecord& ray, const ExactHit& truth);

/// Collects the rays of a frame over seeds.
class JudgedHits {
public:
    /// `truth`: of recorded.rays. Of the pixels inside each mask (everywhere, if `inside` is empty) one in `every`
    /// counts along each axis.
    void add(unsigned seed, const RecordedRays& recorded, const std::vector<ExactHit>& truth, glm::uvec2 extent,
             unsigned every, const std::vector<Mask>& masks);

    /// `shared`: shot, frame, technique and point. Means over the seeds with an interval: of shares that of counts,
    /// where few rays change with the seed, else Student's; none with a single seed, nor of distances and fetches with
    /// fewer than 4 seeds or 20 rays. A quantity that a seed lacks (no ray in the mask) is left to the others.
    std::vector<HitRow> rows(const HitRow& shared) const;

private:
    struct Count {
        double rays = 0;
        VerdictSums verdicts{};
        std::vector<double> missed_by_outcome;
        std::vector<float> distance_errors;          ///< relative, of rays that were right
        std::map<unsigned, size_t> rays_by_fetches;  ///< a large shot has millions of rays, of some hundred counts
    };
    struct Key {
        std::string stage, mask;
        auto operator<=>(const Key&) const = default;
    };
    std::vector<std::pair<Key, std::vector<Count>>> counts_;  ///< in the order of their first coming; one per seed
    std::vector<unsigned> seeds_;

    Count& count(const Key& key, unsigned seed);
    static std::optional<double> median_distance_error(const Count& count);  ///< none without right rays
    /// The number of fetches that at least that share of the rays does not exceed; none without rays.
    static std::optional<double> fetches_quantile(const Count& count, double share_below);
};

/// The verdict of each pixel's first ray in one colour each (RGB), black where none was traced: right green, wrong
/// place orange, false hit red-purple, avoidable miss yellow, unavoidable miss blue, empty grey (Okabe and Ito's
/// colours, distinguishable with any colour vision).
HostImage map_of_verdicts(const RecordedRays& recorded, const std::vector<ExactHit>& truth, glm::uvec2 extent);
