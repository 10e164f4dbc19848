#pragma once
#include "core/variant.h"
#include "variants/common/repaired_inputs.h"
#include "variants/tracers/tracers.h"

/// A technique that traces rays: what its chosen tracers ask for is asked for by it.
class TracingVariant : public Variant {
public:
    Reflections render(PassGraph& graph, const GBuffer& gbuffer) final {
        const RepairedInputs inputs(graph, gbuffer, repair_inputs_ && !is_sound_);
        return render_passes(graph, inputs.gbuffer());
    }
    std::vector<LeftOut> leave_out(const SceneFacts& facts) final {
        std::vector<LeftOut> left_out = leave_out_passes(facts);
        is_sound_ = !facts.has_faulty_inputs;
        if (repair_inputs_ && is_sound_)
            left_out.push_back({RepairedInputs::stage, "no faulty inputs", "every pixel would keep its bits"});
        return left_out;
    }
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
    virtual Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) = 0;  ///< Variant::render()
    virtual std::vector<LeftOut> leave_out_passes(const SceneFacts& facts) = 0;       ///< Variant::leave_out()

private:
    Switch repair_inputs_{
        params,
        "repair_inputs",
        false,
        {"",
         "takes values that are not finite, and normals that are not unit, out of the G-buffer first: such a pixel is "
         "background, black, still or faces the viewer, and no other pixel sees its fault. Left out where the inputs "
         "are known to be sound",
         "ssrlab"}};
    bool is_sound_ = false;
};
