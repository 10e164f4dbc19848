#include "groundtruth/paths/path_lanes.h"

#include <algorithm>
#include <bit>

namespace {

/// Keeps a wrong estimate affordable.
constexpr unsigned most_parts = 32;

/// Pairs of the parts of a path begin here, each at a place of its own that is drawn by a hash: parts that meet there
/// by chance would be correlated, but not biased.
constexpr uint32_t branch_stream = 1u << 20;

}  // namespace

/// Of the directions from a vertex: the light sample there stays one, with the path that is in the lane.
void PathLanes::split(int lane, float wanted_parts) {
    const auto parts = unsigned(std::min(wanted_parts, float(most_parts)));
    part_[lane] = 1.0f / float(parts);
    for (unsigned part = 1; part < parts; ++part)
        branches_.push_back({
            .estimate = estimate_[lane],
            .sequence = sequence(lane),
            .direction = direction_.get(lane),
            .throughput = throughput_.get(lane),
            .weight = weight_.get(lane),
            .position = position_.get(lane),
            .error = error_.get(lane),
            .geometric_normal = geometric_normal_.get(lane),
            .normal = normal_.get(lane),
            .base_color = base_color_.get(lane),
            .dielectric_f0 = dielectric_f0_.get(lane),
            .metalness = metalness_[lane],
            .roughness = roughness_[lane],
            .specular = specular_[lane],
            .per_estimate = per_estimate_[lane],
            .promise = promise_[lane],
            .part = part_[lane],
            .depth = depth_[lane],
            .pair = branch_stream | hash_bits(pair_[lane] * most_parts + part),
            .reversed_sample = reversed_sample_[lane],
            .is_specular = is_specular_[lane],
            .learnt_index = learnt_index_[lane],
        });
}

/// Gives free lanes to branches.
void PathLanes::resume_branches() {
    for (; !branches_.empty() && busy_ != all_lanes; branches_.pop_back()) {
        const Branch& branch = branches_.back();
        const int lane = std::countr_one(busy_);
        busy_ |= 1u << lane;
        resumed_ |= 1u << lane;
        estimate_[lane] = branch.estimate;
        seed_a_[lane] = branch.sequence.seed_a, seed_b_[lane] = branch.sequence.seed_b;
        direction_.set(lane, branch.direction);
        throughput_.set(lane, branch.throughput);
        radiance_.set(lane, vec3(0.0f));
        weight_.set(lane, branch.weight);
        position_.set(lane, branch.position);
        error_.set(lane, branch.error);
        geometric_normal_.set(lane, branch.geometric_normal);
        normal_.set(lane, branch.normal);
        base_color_.set(lane, branch.base_color);
        dielectric_f0_.set(lane, branch.dielectric_f0);
        metalness_[lane] = branch.metalness;
        roughness_[lane] = branch.roughness;
        specular_[lane] = branch.specular;
        per_estimate_[lane] = branch.per_estimate;
        promise_[lane] = branch.promise;
        part_[lane] = branch.part;
        depth_[lane] = branch.depth;
        pair_[lane] = branch.pair;
        reversed_sample_[lane] = branch.reversed_sample;
        is_specular_[lane] = branch.is_specular;
        learnt_index_[lane] = branch.learnt_index;
    }
}
