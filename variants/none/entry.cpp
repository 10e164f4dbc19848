#include "variants/common/variant_entry.h"
#include "variants/none/none.h"

VariantEntry none_entry() {
    return {
        .name = "none",
        .title = "No screen-space reflections",
        .source = "ssrlab",
        .description = "Confidence 0 everywhere: the fallback alone, the baseline of all techniques.",
        .presets = {},
        .create = [] { return std::make_unique<None>(); },
    };
}
