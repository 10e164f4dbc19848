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

/// Verdict on a ray, from its true hit and its tracer's answer. A hit of confidence c counts as c of a hit and 1 - c of
/// a miss.
enum class RayVerdict {
    right,             ///< the true hit is visible, and the answer lies within one pixel of it
    wrong_place,       ///< the true hit is visible, and the answer is another place
    false_hit,         ///< no visible true hit, but the tracer answers one
    avoidable_miss,    ///< the true hit is visible, and the tracer misses it
    unavoidable_miss,  ///< the true hit is hidden, off the screen or behind the camera; missed
    empty,             ///< the ray leaves the scene or starts below its surface; missed
};
inline constexpr size_t ray_verdict_count = 6;
const std::array<const char*, ray_verdict_count>& ray_verdict_names();

RayVerdict verdict_of_hit(const RayRecord& ray, const ExactHit& truth);
RayVerdict verdict_of_miss(const ExactHit& truth);

/// The weight of each verdict; the weights of one ray add up to 1.
using VerdictSums = std::array<double, ray_verdict_count>;
void add_verdicts(VerdictSums& sums, const RayRecord& ray, const ExactHit& truth);

/// Collects the rays of a frame over seeds.
class JudgedHits {
public:
    /// `truth`: true hits of recorded.rays. One pixel in `every` along each axis counts, inside each mask (an empty
    /// `inside` means everywhere).
    void add(unsigned seed, const RecordedRays& recorded, const std::vector<ExactHit>& truth, glm::uvec2 extent,
             unsigned every, const std::vector<Mask>& masks);

    /// `shared`: shot, frame, technique and point. Values are means over the seeds with an interval: Student's, but for
    /// shares that of counts where few rays change with the seed. There is none for a single seed, nor for distances
    /// and fetches with fewer than 4 seeds or 20 rays. A seed without a quantity (no ray in the mask) does not enter
    /// its mean.
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
    std::vector<std::pair<Key, std::vector<Count>>> counts_;  ///< in order of first use; one count for each seed
    std::vector<unsigned> seeds_;

    Count& count(const Key& key, unsigned seed);
    static std::optional<double> median_distance_error(const Count& count);  ///< none without right rays
    /// The number of fetches that at least this share of the rays does not exceed; none without rays.
    static std::optional<double> fetches_quantile(const Count& count, double share_below);
};

/// Picture (RGB) of the verdict of each pixel's first ray; black where none was traced. Colours are Okabe and Ito's,
/// distinguishable with any colour vision: right green, wrong place orange, false hit red-purple, avoidable miss
/// yellow, unavoidable miss blue, empty grey.
HostImage map_of_verdicts(const RecordedRays& recorded, const std::vector<ExactHit>& truth, glm::uvec2 extent);
