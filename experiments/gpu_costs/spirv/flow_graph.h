#pragma once
#include <cstddef>
#include <vector>

/// Blocks of a program, by their places, and ways from one to another. The first is where it starts; it ends where a
/// block has no way on.
class FlowGraph {
public:
    explicit FlowGraph(size_t blocks) : next_(blocks), previous_(blocks) {}

    void add_edge(size_t from, size_t to);
    size_t size() const { return next_.size(); }
    const std::vector<unsigned>& next(size_t block) const { return next_[block]; }
    const std::vector<unsigned>& previous(size_t block) const { return previous_[block]; }

    /// Every block that can be reached, none before all that lead to it but those of loops.
    std::vector<size_t> order() const;

private:
    std::vector<std::vector<unsigned>> next_, previous_;
};

/// For each block the nearest other one that all ways from the start to it pass; size(): there is none.
std::vector<unsigned> nearest_dominators(const FlowGraph& pass_list);
/// For each block the nearest other one that all ways from it to an end pass; size(): there is none.
std::vector<unsigned> nearest_postdominators(const FlowGraph& pass_list);
/// For each block how many loops it is in. A loop is all that leads from a block back to it.
std::vector<unsigned> loop_depths(const FlowGraph& pass_list);
