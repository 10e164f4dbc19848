#pragma once
#include "core/reading_limits.h"
#include "variants/common/technique.h"
#include "variants/passes/declaration.h"
#include "variants/passes/provided_images.h"

#include <span>

/// One frame of what a technique or a denoiser declares: its images and buffers by name, and its passes, run one by one
/// in their order.
class DeclaredPasses {
public:
    /// What the declaration does not hold. `tracers`: null if no pass traces.
    struct Around {
        PassList& pass_list;
        const GBuffer& gbuffer;
        ProvidedImages& provided;
        const Tracers* tracers = nullptr;
        RayProbe* ray_probe = nullptr;
    };

    /// `params`: the pass_list's. `known`: values of parameters and, if known, of the shot. Images and buffers in
    /// `given` and `given_buffers` replace declared ones of their names. All references must outlive this.
    DeclaredPasses(const Declaration& declaration, const ParameterSet& params, KnownValues known, const Around& around,
                   std::map<std::string, Image> given = {}, std::map<std::string, Buffer> given_buffers = {});

    void run_all();
    void run(const DeclaredPass& pass);
    Reflections result();

    /// An own, given or provided image; provided ones are made at their first use.
    Image image(const std::string& name, NoiseStage stage = NoiseStage::compute);
    const Buffer& buffer(const std::string& name) const { return buffers_.at(name); }
    const KnownValues& known() const { return known_; }
    /// The pyramids of depth that the passes' tracers need, made once.
    const Tracers::Images& pyramids();
    void set_pyramids(Tracers::Images pyramids) { pyramids_ = std::move(pyramids); }

private:
    size_t bytes_of(const DeclaredBuffer& buffer) const;
    void set_memory_aside();
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
    MemoryShare memory_;  ///< of images and buffers
    std::map<std::string, Image> images_;
    std::map<std::string, Buffer> buffers_;
    std::map<std::string, const DeclaredImage*> declared_;  ///< the images in use
    std::map<std::string, bool> is_cleared_;
    std::optional<Tracers::Images> pyramids_;
};

/// The slots of the tracers that passes include.
std::vector<std::string> slots_of(const std::vector<const DeclaredPass*>& passes);

/// A way to make depth pyramids that a technique can choose: its stage and its shaders.
struct NamedPyramidMaker {
    std::string name, stage;
    std::vector<std::string> shaders;
    PyramidMaker make;
};
std::span<const NamedPyramidMaker> pyramid_makers();
/// The technique's maker; the first of pyramid_makers() if it names none.
const NamedPyramidMaker& pyramid_maker(const Declaration& declaration, const KnownValues& known);
