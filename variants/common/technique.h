#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/reflections.h"
#include "core/gbuffer/scene_facts.h"
#include "core/gpu/passes/pass_list.h"
#include "core/gpu/pipelines/shader.h"
#include "core/left_out.h"
#include "core/parameters.h"
#include "core/ray_probe.h"

#include <string>

/// One screen-space reflection technique: its parameters and its passes in order.
class Technique {
public:
    virtual ~Technique() = default;

    /// Adds this frame's passes. Called once per frame, in temporal order, after PassList::begin_frame(), which was
    /// given the images of `gbuffer`: every shader may name them (`depth`, `normal`, `lit`, ...) without a
    /// Pass::read(), which is for the technique's own images, and for sampling other than by texel.
    virtual Reflections render(PassList& pass_list, const GBuffer& gbuffer) = 0;

    /// Called before the first frame of a shot, after the parameters are set; not called under --keep-all. From then on
    /// render() skips the stages returned, which would not have changed a pixel.
    virtual std::vector<LeftOut> leave_out(const SceneFacts&) { return {}; }

    /// Whether another seed may give another result: false where no random number is drawn, so that one seed is enough.
    /// Called after the parameters are set.
    virtual bool depends_on_seed() const { return true; }

    /// Why a seed's result may differ from run to run, as a clause that names the parameter; empty if it does
    /// not. Called after the parameters are set.
    virtual std::string not_repeatable() const { return {}; }

    /// Includes that depend on the parameters, for compiling the technique's shaders outside of render().
    virtual ShaderIncludes shader_includes() const { return {}; }

    /// Whether render() reads GBuffer::second_depth or ::back_depth. Called after the parameters are set.
    virtual bool needs_depth_layers() const { return false; }

    /// Whether render() uses ray_probe->exact_hits, which is scene data; its time is then not meaningful. Called after
    /// the parameters are set.
    virtual bool uses_scene_data() const { return false; }

    /// Whether PassList::use_gpu_forms() may change a pass. Called after the parameters are set.
    virtual bool has_gpu_forms() const { return false; }

    RayProbe* ray_probe = nullptr;  ///< connects an experiment with the tracers

    ParameterSet params;
    Limits limits = Limits::none;  ///< of the passes that render() adds; its caller opens a LimitScope with them
};
