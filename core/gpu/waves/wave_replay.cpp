#include "core/gpu/waves/wave_replay.h"

#include "core/error.h"

#include <bit>

namespace {

using Mask = uint64_t;

/// One wave on its way through a shader.
class Wave {
public:
    Wave(const ShaderFlow& flow, std::span<const LaneTrace> lanes, WaveCounts& counts)
        : flow_(flow), lanes_(lanes), next_(lanes.size()), counts_(counts) {}

    void run() {
        Mask started = 0;
        for (size_t lane = 0; lane < lanes_.size(); ++lane)
            if (lanes_[lane].has_run) started |= Mask(1) << lane;
        if (!started) return;
        ++counts_.started;
        const unsigned end = unsigned(flow_.blocks.size());
        std::vector<Part> parts = {{.block = 0, .until = end, .lanes = started}};
        while (!parts.empty()) {
            Part& part = parts.back();
            part.lanes &= ~ended_;
            if (part.block == part.until || part.block == end || !part.lanes) {
                parts.pop_back();
                continue;
            }
            counts_.waves[part.block] += 1;
            counts_.lanes[part.block] += unsigned(std::popcount(part.lanes));
            go_on(parts);
        }
    }

private:
    /// Lanes that go together until a block that others of the wave wait at.
    struct Part {
        unsigned block, until;
        Mask lanes;
    };

    void go_on(std::vector<Part>& parts) {
        Part& part = parts.back();
        const ShaderFlow::Block& block = flow_.blocks[part.block];
        if (block.successors.empty()) {
            ended_ |= part.lanes;
            return;
        }
        std::vector<Mask> by_successor(block.successors.size(), 0);
        for (size_t lane = 0; lane < lanes_.size(); ++lane) {
            if (!(part.lanes >> lane & 1)) continue;
            const std::optional<unsigned> way = decide(lane, block);
            if (way)
                by_successor[*way] |= Mask(1) << lane;
            else
                ended_ |= Mask(1) << lane, ++counts_.cut;
        }
        std::vector<Part> ways;
        for (size_t s = 0; s < block.successors.size(); ++s)
            if (by_successor[s]) ways.push_back({block.successors[s], block.reconvergence, by_successor[s]});
        if (ways.size() == 1) {
            part.block = ways.front().block;
            return;
        }
        part.block = block.reconvergence;  // where those wait that are there already
        parts.insert(parts.end(), ways.begin(), ways.end());
    }

    /// The successor that a lane takes; nothing where its trace ends.
    std::optional<unsigned> decide(size_t lane, const ShaderFlow::Block& block) {
        if (!block.decisions) return 0;
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
    Mask ended_ = 0;
    WaveCounts& counts_;
};

}  // namespace

void WaveCounts::add(const WaveCounts& other) {
    waves.resize(std::max(waves.size(), other.waves.size())), lanes.resize(waves.size());
    for (size_t i = 0; i < other.waves.size(); ++i) waves[i] += other.waves[i], lanes[i] += other.lanes[i];
    started += other.started, cut += other.cut;
}

WaveCounts replay(const ShaderFlow& flow, std::span<const LaneTrace> group, unsigned width) {
    if (width < 1 || width > 64) fail("a wave has 1 to 64 lanes, not ", width);
    WaveCounts counts;
    counts.waves.resize(flow.blocks.size()), counts.lanes.resize(flow.blocks.size());
    for (size_t first = 0; first < group.size(); first += width)
        Wave(flow, group.subspan(first, std::min<size_t>(width, group.size() - first)), counts).run();
    return counts;
}
