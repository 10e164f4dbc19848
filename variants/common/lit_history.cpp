#include "variants/common/lit_history.h"

#include <utility>

Image LitHistory::previous(PassGraph& graph, const Image& lit) {
    const PassGraph::History kept = graph.history("kept_lit", lit.format);
    graph.fragment("common/keep_lit.frag").read(lit.as("lit")).write(kept.current).run();
    return std::exchange(is_kept_, true) ? kept.previous : lit;
}
