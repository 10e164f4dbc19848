#pragma once
#include "core/variant.h"
#include "variants/tracers/tracers.h"

/// A technique that traces rays: what its chosen tracers ask for is asked for by it.
class TracingVariant : public Variant {
public:
    ShaderIncludes shader_includes() const override { return chosen_tracers().includes(); }
    bool asks_scene() const override { return chosen_tracers().needs().exact_hits; }
    bool needs_depth_layers() const override { return chosen_tracers().needs().depth_layers; }

protected:
    virtual const Tracers& chosen_tracers() const = 0;
};
