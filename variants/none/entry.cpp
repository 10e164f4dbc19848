#include "variants/common/variant_entry.h"
#include "variants/none/none.h"

VariantEntry none_entry() {
    return {
        .name = "none",
        .title = "No screen-space reflections",
        .source = "ssrlab",
        .description = "Confidence 0 everywhere: the fallback alone, against which every technique is read.",
        .presets = {},
        .create = [] { return std::make_unique<None>(); },
    };
}
