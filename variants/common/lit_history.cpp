#include "variants/common/lit_history.h"

Image LitHistory::previous(PassGraph& graph, const Image& lit) {
    const PassGraph::History kept = graph.history("kept_lit", lit.format);
    graph.fragment("common/keep_lit.frag").read(lit.as("lit")).write(kept.current).run();
    // Images of another size, or of another graph, hold nothing yet.
    const bool is_kept = kept.previous.storage == last_.storage && last_.storage;
    last_ = kept.current;
    return is_kept ? kept.previous : lit;
}
