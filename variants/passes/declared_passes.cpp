#include "variants/passes/declared_passes.h"

#include "core/error.h"
#include "core/gbuffer/environment_images.h"
#include "core/gpu/device.h"
#include "variants/common/depth_pyramid.h"
#include "variants/common/drawn_pyramid/drawn_pyramid.h"

std::span<const NamedPyramidMaker> pyramid_makers() {
    static const auto drawn = [](bool has_mip_views) {
        return [=](PassList& pass_list, const Image& depth, unsigned mips, bool keeps_farthest) {
            return drawn_pyramid(pass_list, depth, mips, keeps_farthest, has_mip_views);
        };
    };
    static const std::vector<NamedPyramidMaker> makers = {
        {"one_dispatch", "common/depth_pyramid", {"common/depth_pyramid.comp"}, depth_pyramid},
        {"draws", drawn_pyramid_stage, drawn_pyramid_shaders, drawn(true)},
        {"draws_and_copies", drawn_pyramid_stage, drawn_pyramid_shaders, drawn(false)}};
    return makers;
}

const NamedPyramidMaker& pyramid_maker(const Declaration& declaration, const KnownValues& known) {
    const DeclaredPyramid* chosen = first_that_holds(declaration.pyramids, known);
    return chosen ? *std::ranges::find(pyramid_makers(), chosen->maker, &NamedPyramidMaker::name)
                  : pyramid_makers().front();
}

std::vector<std::string> slots_of(const std::vector<const DeclaredPass*>& passes) {
    std::vector<std::string> slots;
    for (const DeclaredPass* pass : passes)
        for (const std::string& slot : pass->tracers)
            if (!std::ranges::count(slots, slot)) slots.push_back(slot);
    return slots;
}

DeclaredPasses::DeclaredPasses(const Declaration& declaration, const ParameterSet& params, KnownValues known,
                               const Around& around, std::map<std::string, Image> given,
                               std::map<std::string, Buffer> given_buffers)
    : declaration_(declaration),
      params_(params),
      known_(std::move(known)),
      around_(around),
      images_(std::move(given)),
      buffers_(std::move(given_buffers)) {
    known_.set("device.is_gpu", around.pass_list.uses_gpu_forms());
    known_.derive(declaration.conditions);
    set_memory_aside();
    make_images();
}

size_t DeclaredPasses::bytes_of(const DeclaredBuffer& buffer) const {
    const glm::uvec2 extent = buffer.share.of(around_.pass_list.extent());
    const size_t times = buffer.times.empty() ? 1 : known_.by_name().at(buffer.times).get<size_t>();
    return buffer.bytes + size_t(extent.x) * extent.y * times * buffer.bytes_per_pixel;
}

/// A declaration may be a stranger's, and ask for more than the machine has.
void DeclaredPasses::set_memory_aside() {
    const glm::uvec2 screen = around_.pass_list.extent();
    double bytes = 0;
    for (const DeclaredImage* image : in_use(declaration_.images, &DeclaredImage::name, known_)) {
        if (images_.contains(image->name) || !image->same_as.empty()) continue;
        const glm::uvec2 extent = image->share.of(screen);
        const bool has_mips = !image->has_history && !image->is_kept;
        const Image asked{.name = image->name,
                          .format = image->format,
                          .extent = extent,
                          .mips = has_mips ? image->mips_of(extent) : 1,
                          .storage = {}};
        bytes += double(::bytes_of(asked)) * (image->has_history ? 2 : 1);
    }
    for (const DeclaredBuffer* buffer : in_use(declaration_.buffers, &DeclaredBuffer::name, known_))
        if (!buffers_.contains(buffer->name)) bytes += double(bytes_of(*buffer));
    memory_.add(bytes, message_text("technique '", declaration_.name, "': its images and buffers at ", screen.x, "x",
                                    screen.y));
}

void DeclaredPasses::make_images() {
    PassList& pass_list = around_.pass_list;
    for (const DeclaredImage* image : in_use(declaration_.images, &DeclaredImage::name, known_)) {
        declared_[image->name] = image;
        if (images_.contains(image->name) || !image->same_as.empty()) continue;
        const glm::uvec2 extent = image->share.of(pass_list.extent());
        if (image->has_history) {
            const PassList::History history = pass_list.history(image->name, image->format, extent);
            images_[image->name] = history.current, images_[history.previous.name] = history.previous;
        } else {
            images_[image->name] = image->is_kept
                                       ? pass_list.image_black_at_first(image->name, image->format, extent)
                                       : pass_list.image_of(image->name, image->format, extent, image->mips_of(extent));
        }
    }
    for (const DeclaredBuffer* buffer : in_use(declaration_.buffers, &DeclaredBuffer::name, known_)) {
        if (!buffers_.contains(buffer->name))
            buffers_[buffer->name] = pass_list.buffer(buffer->name, bytes_of(*buffer));
    }
}

Image DeclaredPasses::image(const std::string& name, NoiseStage stage) {
    if (const auto own = images_.find(name); own != images_.end()) return own->second;
    if (const auto declared = declared_.find(name); declared != declared_.end())
        return image(declared->second->same_as, stage).as(name);
    return around_.provided.image(around_.pass_list, around_.gbuffer, name, params_, stage);
}

const Tracers::Images& DeclaredPasses::pyramids() {
    if (!pyramids_)
        pyramids_ =
            around_.tracers->images(around_.pass_list, around_.gbuffer.depth, pyramid_maker(declaration_, known_).make,
                                    slots_of(declaration_.passes_in_use(known_)));
    return *pyramids_;
}

void DeclaredPasses::run_all() {
    for (const DeclaredPass* pass : declaration_.passes_in_use(known_)) run(*pass);
}

Reflections DeclaredPasses::result() {
    const DeclaredResult* result = first_that_holds(declaration_.results, known_);
    if (!result) fail("technique '", declaration_.name, "' has no result with these values of its parameters");
    return {image(result->radiance), image(result->confidence), result->channel};
}

void DeclaredPasses::run(const DeclaredPass& pass) {
    if (!pass.cleared.empty()) return clear(pass);
    if (pass.each_mip_of.empty()) return run_for(pass, 0);
    for (unsigned level = pass.first_mip; level < images_.at(pass.each_mip_of).mips; ++level) run_for(pass, level);
}

void DeclaredPasses::clear(const DeclaredPass& pass) {
    PushValue value = pass.set.at("value");
    if (!pass.cleared_to.empty()) value = glm::vec4(known_.by_name().at(pass.cleared_to).get<float>());
    if (const auto buffer = buffers_.find(pass.cleared); buffer != buffers_.end())
        return around_.pass_list.clear(buffer->second, std::holds_alternative<int>(value) ? std::get<int>(value) : 0);
    const auto* color = std::get_if<glm::vec4>(&value);
    around_.pass_list.clear(images_.at(pass.cleared), color ? *color : glm::vec4(0));
}

void DeclaredPasses::clear_what_is_written(const DeclaredPass& pass) {
    const auto clear = [&](const std::string& name) {
        const auto declared = declared_.find(name);
        if (declared == declared_.end() || is_cleared_[name] || !declared->second->is_cleared.holds(known_)) return;
        around_.pass_list.clear(images_.at(name), declared->second->cleared_to);
        is_cleared_[name] = true;
    };
    for (const DeclaredUse* write : in_use(pass.writes, &DeclaredUse::as, known_)) clear(write->image);
    for (const auto* tests : {&pass.depth, &pass.stencil})
        if (const DeclaredTest* test = first_that_holds(*tests, known_); test && test->is_written) clear(test->image);
}

Image DeclaredPasses::used(const DeclaredUse& use, unsigned level, NoiseStage stage) {
    const Image whole = image(use.image, stage);
    using enum DeclaredUse::Mips;
    const Image image = use.mips == all       ? whole
                        : use.mips == one     ? whole.mip(use.mip)
                        : use.mips == current ? whole.mip(level)
                                              : whole.mip(level - 1);
    return image.as(use.as);
}

void DeclaredPasses::run_for(const DeclaredPass& declared, unsigned level) {
    PassList& pass_list = around_.pass_list;
    const DeclaredForm& form = declared.form(known_);
    const NoiseStage stage = form.is_compute() ? NoiseStage::compute : NoiseStage::fragment;
    std::vector<std::pair<Image, Sampling>> reads;  // made before the pass, for some are passes themselves
    for (const DeclaredUse* read : in_use(declared.reads, &DeclaredUse::as, known_))
        reads.emplace_back(
            used(*read, level, stage),
            Sampling{.is_linear = read->is_linear.holds(known_), .wrap_u = read->wrap_u, .wrap_v = read->wrap_v});
    if (!declared.tracers.empty()) pyramids();
    clear_what_is_written(declared);
    PassList::Pass pass = form.is_compute() ? pass_list.compute(form.shader) : pass_list.fragment(form.shader);
    pass.label(declared.stage);
    for (const auto& [image, sampling] : reads) pass.read(image, sampling);
    for (const DeclaredUse* write : in_use(declared.writes, &DeclaredUse::as, known_))
        pass.write(used(*write, level, stage));
    if (const DeclaredTest* test = first_that_holds(declared.depth, known_))
        pass.depth({.compare = test->compare, .is_written = test->is_written, .image = image(test->image)});
    if (const DeclaredTest* test = first_that_holds(declared.stencil, known_))
        pass.stencil({.mode = test->mode, .value = test->value, .image = image(test->image)});
    for (const std::string& buffer : declared.buffers) pass.use(buffers_.at(buffer).as(buffer));
    for (const DeclaredInclude* include : in_use(declared.includes, &DeclaredInclude::name, known_)) {
        if (include->needs_half_floats && !pass_list.device().has_half_floats())
            fail_machine(include->file, ": the Vulkan device '", pass_list.device().info().name,
                         "' has no half floats in shaders");
        pass.include(include->name, "#include \"" + include->file + "\"\n");
    }
    for (const auto& [name, value] : declared.set) {
        if (const auto* mip = std::get_if<MipValue>(&value))
            pass.set(name, float(mip->last_of.empty() ? level : images_.at(mip->last_of).mips - 1));
        if (const auto* number = std::get_if<int>(&value)) pass.set(name, *number);
        if (const auto* number = std::get_if<float>(&value)) pass.set(name, *number);
        if (const auto* number = std::get_if<glm::vec4>(&value)) pass.set(name, *number);
    }
    if (declared.has_environment) bind_environment(pass, around_.gbuffer);
    if (declared.tracers.empty()) return dispatch(declared, pass);
    around_.tracers->run(pass_list, pass, declared.tracers, pyramids(), around_.ray_probe, rays_of(declared),
                         [&](PassList::Pass& once) { dispatch(declared, once); });
}

void DeclaredPasses::dispatch(const DeclaredPass& declared, PassList::Pass& once) {
    const DeclaredForm& form = declared.form(known_);
    const glm::uvec2 screen = around_.pass_list.extent();
    if (!form.is_compute()) return once.run();
    if (form.groups.x > 0) return once.dispatch_groups({form.groups, 1});
    if (form.pixels_per_group.x > 0)
        return once.dispatch_groups({(screen + form.pixels_per_group - 1u) / form.pixels_per_group, 1});
    if (!form.arguments.empty()) return once.dispatch(buffers_.at(form.arguments), form.arguments_at);
    if (const DeclaredExtent* over = first_that_holds(declared.over, known_)) {
        if (over->image == traced_pixels)
            return once.run(
                ScreenShare{.divisor = known_.by_name().at("half_resolution") == true ? 2u : 1u, .rounds_up = true}.of(
                    screen));
        return once.run(over->image.empty() ? over->share.of(screen) : images_.at(over->image).extent);
    }
    if (declared.writes.empty()) return once.run(screen);
    once.run();
}

unsigned DeclaredPasses::rays_of(const DeclaredPass& pass) const {
    return pass.rays_parameter.empty() ? pass.rays : known_.by_name().at(pass.rays_parameter).get<unsigned>();
}
