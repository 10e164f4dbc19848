#include "experiments/gpu_costs/waves/wave_replay.h"

#include "core/error.h"

#include <bit>
#include <map>

namespace {

using Mask = uint64_t;

/// One wave on its way through a shader.
class Wave {
public:
    Wave(const ShaderFlow& flow, std::span<const LaneTrace> lanes, WaveCounts& counts)
        : flow_(flow), lanes_(lanes), next_(lanes.size()), counts_(counts) {}

    void run() {
        for (size_t lane = 0; lane < lanes_.size(); ++lane)
            if (lanes_[lane].has_run) go_to(0, Mask(1) << lane);
        counts_.started += !at_.empty();
        while (!at_.empty()) {
            const auto [block, lanes] = at_.begin()->second;
            at_.erase(at_.begin());
            counts_.waves[block] += 1;
            counts_.lanes[block] += unsigned(std::popcount(lanes));
            go_on(flow_.blocks[block], lanes);
        }
    }

private:
    struct Place {
        unsigned block;
        Mask lanes;
    };

    void go_to(unsigned block, Mask lanes) {
        at_.try_emplace(flow_.blocks[block].rank, Place{block, 0}).first->second.lanes |= lanes;
    }

    void go_on(const ShaderFlow::Block& block, Mask lanes) {
        if (block.successors.empty()) return;
        if (!block.decisions) return go_to(block.successors[0], lanes);
        by_successor_.assign(block.successors.size(), 0);
        for (; lanes; lanes &= lanes - 1) {
            const auto lane = size_t(std::countr_zero(lanes));
            if (const std::optional<unsigned> way = decide(lane, block))
                by_successor_[*way] |= Mask(1) << lane;
            else
                ++counts_.cut;
        }
        for (size_t s = 0; s < by_successor_.size(); ++s)
            if (by_successor_[s]) go_to(block.successors[s], by_successor_[s]);
    }

    /// The successor that a lane takes; nothing where its trace ends.
    std::optional<unsigned> decide(size_t lane, const ShaderFlow::Block& block) {
        uint64_t& next = next_[lane];
        const LaneTrace& trace = lanes_[lane];
        if (next + block.decisions > trace.words.size() * 32) return {};
        if (next + block.decisions > trace.decisions) fail("a lane's trace ends before its shader does");
        std::optional<unsigned> chosen;
        for (unsigned i = 0; i < block.decisions; ++i, ++next)
            if (!chosen && trace.words[next / 32] >> next % 32 & 1) chosen = i;
        return chosen.value_or(block.decisions);
    }

    const ShaderFlow& flow_;
    const std::span<const LaneTrace> lanes_;
    std::vector<uint64_t> next_;  ///< decision, by lane
    std::vector<Mask> by_successor_;
    std::map<unsigned, Place> at_;  ///< by rank, where lanes are
    WaveCounts& counts_;
};

}  // namespace

WaveCounts replay(const ShaderFlow& flow, std::span<const LaneTrace> group, unsigned width) {
    if (width < 1 || width > 64) fail("a wave has 1 to 64 lanes, not ", width);
    WaveCounts counts;
    counts.waves.resize(flow.blocks.size()), counts.lanes.resize(flow.blocks.size());
    for (size_t first = 0; first < group.size(); first += width)
        Wave(flow, group.subspan(first, std::min<size_t>(width, group.size() - first)), counts).run();
    return counts;
}
