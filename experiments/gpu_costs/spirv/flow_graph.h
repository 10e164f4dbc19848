#pragma once
#include <cstddef>
#include <vector>

/// Blocks of a program by index, and edges between them. Block 0 is the start; blocks without successors are ends.
class FlowGraph {
public:
    explicit FlowGraph(size_t blocks) : next_(blocks), previous_(blocks) {}

    void add_edge(size_t from, size_t to);
    size_t size() const { return next_.size(); }
    const std::vector<unsigned>& next(size_t block) const { return next_[block]; }
    const std::vector<unsigned>& previous(size_t block) const { return previous_[block]; }

    /// All reachable blocks, each after all its predecessors except those along back edges of loops.
    std::vector<size_t> order() const;

private:
    std::vector<std::vector<unsigned>> next_, previous_;
};

/// For each block the nearest other block that all paths from the start pass; size(): none.
std::vector<unsigned> nearest_dominators(const FlowGraph& graph);
/// For each block the nearest other block that all paths to an end pass; size(): none.
std::vector<unsigned> nearest_postdominators(const FlowGraph& graph);
/// For each block the number of loops that contain it. A loop is everything on a path from a block back to itself.
std::vector<unsigned> loop_depths(const FlowGraph& graph);
