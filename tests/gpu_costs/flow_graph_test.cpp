#include "experiments/gpu_costs/spirv/flow_graph.h"

#include <gtest/gtest.h>

namespace {

FlowGraph graph_of(size_t blocks, const std::vector<std::pair<size_t, size_t>>& edges) {
    FlowGraph graph(blocks);
    for (const auto& [from, to] : edges) graph.add_edge(from, to);
    return graph;
}

}  // namespace

/// The graph of figure 4 in Cooper, Harvey & Kennedy 2001, whose nodes 6, 5, 4, 1, 2, 3 are 0 to 5 here: no way to
/// 1, 2 and 3 passes either of 4 and 5, so that 6 dominates all.
TEST(FlowGraph, DominatorsOfAnIrreducibleGraph) {
    const FlowGraph graph = graph_of(6, {{0, 1}, {0, 2}, {1, 3}, {2, 4}, {2, 5}, {3, 4}, {4, 3}, {4, 5}, {5, 4}});
    EXPECT_EQ(nearest_dominators(graph), (std::vector<unsigned>{6, 0, 0, 0, 0, 0}));
}

/// 0 -> loop { 1; inner loop { 2, 3 }; 4, out of which 6 leaves } -> 5.
TEST(FlowGraph, LoopsWithinLoops) {
    const FlowGraph graph = graph_of(7, {{0, 1}, {1, 2}, {2, 3}, {3, 2}, {2, 4}, {4, 1}, {4, 6}, {1, 5}, {6, 5}});
    EXPECT_EQ(loop_depths(graph), (std::vector<unsigned>{0, 1, 2, 2, 1, 0, 0}));
    EXPECT_EQ(nearest_dominators(graph), (std::vector<unsigned>{7, 0, 1, 2, 2, 1, 4}));
    EXPECT_EQ(nearest_postdominators(graph), (std::vector<unsigned>{1, 5, 4, 2, 5, 7, 5}))
        << "4 may go on to 1 or to 6";
}

/// What nothing reaches has none, and what reaches no end has none.
TEST(FlowGraph, BlocksWithoutAWay) {
    const FlowGraph graph = graph_of(4, {{0, 1}, {2, 1}, {0, 3}, {3, 3}});
    EXPECT_EQ(nearest_dominators(graph), (std::vector<unsigned>{4, 0, 4, 0}));
    EXPECT_EQ(nearest_postdominators(graph), (std::vector<unsigned>{1, 4, 1, 4}));
    EXPECT_EQ(graph.order().size(), 3u);
}
