#include "experiments/gpu_costs/spirv/flow_graph.h"

#include <algorithm>
#include <map>
#include <set>

void FlowGraph::add_edge(size_t from, size_t to) {
    next_[from].push_back(unsigned(to)), previous_[to].push_back(unsigned(from));
}

std::vector<size_t> FlowGraph::order() const {
    struct Visit {
        size_t block, edge;
    };
    std::vector<size_t> finished;
    std::vector<bool> is_seen(size(), false);
    std::vector<Visit> path;
    const auto enter = [&](size_t block) {
        if (!is_seen[block]) is_seen[block] = true, path.push_back({block, 0});
    };
    if (size() > 0) enter(0);
    while (!path.empty()) {
        Visit& visit = path.back();
        if (visit.edge < next_[visit.block].size()) {
            enter(next_[visit.block][visit.edge++]);
            continue;
        }
        finished.push_back(visit.block);
        path.pop_back();
    }
    std::ranges::reverse(finished);
    return finished;
}

/// Cooper, Harvey & Kennedy 2001, "A Simple, Fast Dominance Algorithm", figure 3.
std::vector<unsigned> nearest_dominators(const FlowGraph& graph) {
    const unsigned none = unsigned(graph.size());
    const std::vector<size_t> order = graph.order();
    std::vector<unsigned> number(graph.size(), none);  ///< in that order
    for (unsigned i = 0; i < order.size(); ++i) number[order[i]] = i;
    std::vector<unsigned> nearest(order.size(), none);  ///< by these numbers
    if (!order.empty()) nearest[0] = 0;
    for (bool changes = true; changes;) {
        changes = false;
        for (unsigned b = 1; b < order.size(); ++b) {
            unsigned common = none;
            for (const unsigned block : graph.previous(order[b])) {
                unsigned p = number[block];
                if (p == none || nearest[p] == none) continue;
                for (; common != none && p != common;)
                    if (p > common)
                        p = nearest[p];
                    else
                        common = nearest[common];
                common = p;
            }
            if (common != nearest[b]) nearest[b] = common, changes = true;
        }
    }
    std::vector<unsigned> result(graph.size(), none);
    for (unsigned b = 1; b < order.size(); ++b) result[order[b]] = unsigned(order[nearest[b]]);
    return result;
}

std::vector<unsigned> nearest_postdominators(const FlowGraph& graph) {
    FlowGraph backwards(graph.size() + 1);  // the first is the end of all
    for (size_t b = 0; b < graph.size(); ++b) {
        if (graph.next(b).empty()) backwards.add_edge(0, b + 1);
        for (const unsigned next : graph.next(b)) backwards.add_edge(next + 1, b + 1);
    }
    const std::vector<unsigned> nearest = nearest_dominators(backwards);
    std::vector<unsigned> result(graph.size(), unsigned(graph.size()));
    for (size_t b = 0; b < graph.size(); ++b)
        if (const unsigned n = nearest[b + 1]; n > 0 && n < backwards.size()) result[b] = n - 1;
    return result;
}

std::vector<unsigned> loop_depths(const FlowGraph& graph) {
    const std::vector<unsigned> nearest = nearest_dominators(graph);
    const auto dominates = [&](size_t before, size_t block) {
        while (block < graph.size() && block != before) block = nearest[block];
        return block == before;
    };
    std::map<size_t, std::set<size_t>> loops;  ///< by the block that they begin with
    for (const size_t end : graph.order())
        for (const unsigned begin : graph.next(end)) {
            if (!dominates(begin, end)) continue;
            std::set<size_t>& loop = loops[begin];
            loop.insert(begin);
            std::vector<size_t> found = {end};
            while (!found.empty()) {
                const size_t block = found.back();
                found.pop_back();
                if (loop.insert(block).second)
                    found.insert(found.end(), graph.previous(block).begin(), graph.previous(block).end());
            }
        }
    std::vector<unsigned> depths(graph.size(), 0);
    for (const auto& [begin, loop] : loops)
        for (const size_t block : loop) ++depths[block];
    return depths;
}
