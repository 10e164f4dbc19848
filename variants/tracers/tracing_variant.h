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
    /// `stages`, because no pixel would start a ray: nothing reflects, or no such surface does ("as smooth as
    /// max_roughness").
    static std::vector<LeftOut> left_out_without_rays(const SceneFacts& facts, const std::string& such_surface,
                                                      const std::vector<std::string>& stages) {
        const std::string fact =
            facts.has_reflective ? "no reflective surface " + such_surface : std::string("nothing reflective");
        std::vector<LeftOut> left_out;
        for (const std::string& stage : stages) left_out.push_back({stage, fact, "no pixel would start a ray"});
        return left_out;
    }

    virtual const Tracers& chosen_tracers() const = 0;
};
