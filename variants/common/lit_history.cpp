#include "variants/common/lit_history.h"

Image LitHistory::previous(PassList& pass_list, const Image& lit) {
    const PassList::History kept = pass_list.history("kept_lit", lit.format);
    pass_list.fragment("common/keep_lit.frag").read(lit.as("lit")).write(kept.current).run();
    // Images of another size, or of another pass_list, hold nothing yet.
    const bool is_kept = kept.previous.storage == last_.storage && last_.storage;
    last_ = kept.current;
    return is_kept ? kept.previous : lit;
}
