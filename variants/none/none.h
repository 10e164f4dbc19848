#pragma once
#include "core/variant.h"

/// No screen-space reflections: the fallback everywhere. The line that every metric is read against.
class None final : public Variant {
public:
    Reflections render(PassGraph& graph, const GBuffer& gbuffer) override;
    bool depends_on_seed() const override { return false; }
};
