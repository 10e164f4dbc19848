#pragma once
#include "variants/common/repaired_inputs.h"
#include "variants/tracers/tracers.h"
#include "variants/variant.h"

/// A technique that traces rays: what its chosen tracers ask for is asked for by it.
class TracingVariant : public Variant {
public:
    /// What a technique need not do in a scene with these facts.
    struct Needless {
        bool rays = false;           ///< no pixel would start one: all `stages` are left out
        std::string such_a_surface;  ///< "as smooth as max_roughness": that would start some
        std::vector<std::string> stages;

        // Of those that are run:
        std::vector<LeftOut> parts;
        Constants constants;                      ///< that switch `parts` off
        std::vector<std::string> motion_readers;  ///< stages
        std::vector<std::string> environment_readers;
        std::vector<std::string> specular_readers;  ///< that ask of a pixel no more than whether it has a specular term
    };

    Reflections render(PassGraph& graph, const GBuffer& gbuffer) final {
        graph.set_constants(constants_);
        const RepairedInputs inputs(graph, gbuffer, repair_inputs_ && !is_sound_);
        if (has_no_rays_) {
            const Image nothing = graph.image("reflections", Format::rgba16f);
            graph.clear(nothing, {});
            return {nothing, nothing, 3};
        }
        return render_passes(graph, inputs.gbuffer());
    }
    std::vector<LeftOut> leave_out(const SceneFacts& facts) final;

    ShaderIncludes shader_includes() const override { return chosen_tracers().includes(); }
    bool uses_scene_data() const override { return chosen_tracers().needs().exact_hits; }
    bool needs_depth_layers() const override { return chosen_tracers().needs().depth_layers; }

protected:
    virtual const Tracers& chosen_tracers() const = 0;
    virtual Reflections render_passes(PassGraph& graph, const GBuffer& gbuffer) = 0;  ///< Variant::render()
    /// Of Variant::leave_out(). render_passes() skips `parts` from then on, for which `constants` are set; it is not
    /// called where no pixel would start a ray.
    virtual Needless find_needless(const SceneFacts& facts) = 0;

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
    bool is_sound_ = false, has_no_rays_ = false;  // until leave_out()
    Constants constants_;
};
