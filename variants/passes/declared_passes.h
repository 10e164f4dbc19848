#pragma once
#include "variants/common/technique.h"
#include "variants/passes/declaration.h"
#include "variants/passes/provided_images.h"

#include <span>

/// One frame of what a technique or a denoiser declares: its images and buffers by name, and its passes, run one by one
/// in their order.
class DeclaredPasses {
public:
    /// What lies outside of the declaration. Tracers: null where no pass traces.
    struct Around {
        PassList& pass_list;
        const GBuffer& gbuffer;
        ProvidedImages& provided;
        const Tracers* tracers = nullptr;
        RayProbe* ray_probe = nullptr;
    };

    /// `params`: the pass_list's. `known`: of them and of the shot, if that is known. Images and buffers that are
    /// `given` stand in place of the declared ones of their names. All outlive this.
    DeclaredPasses(const Declaration& declaration, const ParameterSet& params, KnownValues known, const Around& around,
                   std::map<std::string, Image> given = {}, std::map<std::string, Buffer> given_buffers = {});

    void run_all();
    void run(const DeclaredPass& pass);
    Reflections result();

    /// Own ones, given ones and provided ones, which are made where they are first asked for.
    Image image(const std::string& name, NoiseStage stage = NoiseStage::compute);
    const Buffer& buffer(const std::string& name) const { return buffers_.at(name); }
    const KnownValues& known() const { return known_; }
    /// The pyramids of depth that the passes' tracers need, made once.
    const Tracers::Images& pyramids();
    void set_pyramids(Tracers::Images pyramids) { pyramids_ = std::move(pyramids); }

private:
    void make_images();
    void clear(const DeclaredPass& pass);
    void clear_what_is_written(const DeclaredPass& pass);
    void run_for(const DeclaredPass& pass, unsigned level);
    Image used(const DeclaredUse& use, unsigned level, NoiseStage stage);
    void dispatch(const DeclaredPass& pass, PassList::Pass& once);
    unsigned rays_of(const DeclaredPass& pass) const;

    const Declaration& declaration_;
    const ParameterSet& params_;
    KnownValues known_;
    Around around_;
    std::map<std::string, Image> images_;
    std::map<std::string, Buffer> buffers_;
    std::map<std::string, const DeclaredImage*> declared_;  ///< those that are in use
    std::map<std::string, bool> is_cleared_;
    std::optional<Tracers::Images> pyramids_;
};

/// The slots of the tracers that passes include.
std::vector<std::string> slots_of(const std::vector<const DeclaredPass*>& passes);

/// One way to make pyramids of depth, that a technique can choose: its stage, and what it draws with.
struct NamedPyramidMaker {
    std::string name, stage;
    std::vector<std::string> shaders;
    PyramidMaker make;
};
std::span<const NamedPyramidMaker> pyramid_makers();
/// That of the technique's; the first of pyramid_makers() where it names none.
const NamedPyramidMaker& pyramid_maker(const Declaration& declaration, const KnownValues& known);
