#include "experiments/bridges/shader_export/frame_passes.h"

#include "core/error.h"
#include "core/gpu/device.h"
#include "core/number_text.h"
#include "core/scene/load_scene.h"
#include "experiments/study/measuring/frames/frame_source.h"
#include "experiments/study/measuring/render_technique.h"
#include "experiments/study/needs.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <set>

namespace {

/// A name that no other collector's change has: a device hands a changed shader out again without asking for its text.
std::string unique_name() {
    static std::atomic<unsigned> count = 0;
    return "exported " + std::to_string(count++);
}

class PassCollector : private PassWatcher {
public:
    explicit PassCollector(PassList& pass_list) : pass_list_(pass_list) {
        pass_list.use_gpu_forms(true);
        pass_list.watch(this);
    }
    ~PassCollector() override { pass_list_.watch(nullptr); }
    PassCollector(const PassCollector&) = delete;
    PassCollector& operator=(const PassCollector&) = delete;

    /// Before each frame. Passes may name an image of the G-buffer otherwise.
    void begin(const GBuffer& gbuffer) {
        inputs_.clear();
        for (const Image& image : gbuffer.images()) inputs_.try_emplace(image.storage.get(), image.name);
    }

    /// Of the frame since the last call.
    std::vector<FrameCommand> take() { return std::exchange(commands_, {}); }

    /// Call it after all frames.
    std::vector<FixedTexels> fixed_texels() {
        std::map<std::string, FixedTexels> found;
        for (const auto& [name, image] : read_)
            if (!written_.contains(image.storage.get())) found[name] = {used(name, image), texels_of(image)};
        std::vector<FixedTexels> all;
        for (auto& [name, fixed] : found) all.push_back(std::move(fixed));
        return all;
    }

private:
    const GlslChange* glsl_change() const override { return &change_; }

    std::optional<InstrumentedPipeline> before(const PassRun& run) override {
        if (run.draws_meshes)
            fail("pass ", run.stage,
                 " draws the scene's meshes, which an exported pass cannot do; choose other parameters");
        std::string& glsl = texts_[run.recipe.spirv.back()];
        if (!compiled_text_.empty()) glsl = std::exchange(compiled_text_, {});
        FrameCommand command{.stage = run.stage,
                             .shader = run.shader,
                             .glsl = glsl,
                             .recipe = run.recipe,
                             .pipeline = run.stage + '\n' + bytes_of({run.recipe}),
                             .params = run.params,
                             .constants = run.constants,
                             .groups = run.recipe.is_compute ? run.groups() : glm::uvec3(0),
                             .push = run.push,
                             .depth = run.depth,
                             .stencil = run.stencil};
        for (const PassRun::BoundImage& bound : run.samplers) {
            command.samplers.push_back(used(bound.name, bound.image, bound.sampling));
            if (!command.samplers.back().is_input) read_.try_emplace(command.samplers.back().resource, bound.image);
        }
        for (const PassRun::BoundImage& bound : run.images)
            command.images.push_back(used(bound.name, bound.image)), written_.insert(bound.image.storage.get());
        for (const Image& target : run.targets)
            command.targets.push_back(used(target.name, target)), written_.insert(target.storage.get());
        for (const Buffer& buffer : run.buffers) command.buffers.push_back(used(buffer));
        if (run.depth.image.storage) command.depth_image = written_test(run.depth.image);
        if (run.stencil.image.storage) command.stencil_image = written_test(run.stencil.image);
        commands_.push_back(std::move(command));
        return {};
    }

    void cleared(const Image& image, glm::vec4 value) override {
        written_.insert(image.storage.get());
        std::string text;
        for (int i = 0; i < 4; ++i) text += (i ? ", " : "") + number_text(double(value[i]), 9);
        FrameCommand command{.stage = "clear", .clear_value = text};
        command.targets.push_back(used(image.name, image));
        commands_.push_back(std::move(command));
    }

    void cleared(const Buffer& buffer) override {
        uint32_t word = 0;
        std::memcpy(&word, pass_list_.download(buffer).data(), sizeof word);
        FrameCommand command{.stage = "clear", .clear_value = std::to_string(word)};
        command.buffers.push_back(used(buffer));
        commands_.push_back(std::move(command));
    }

    UsedResource used(const std::string& variable, const Image& image, const Sampling& sampling = {}) const {
        const std::string own = pass_list_.asked_name(image);
        const auto input = inputs_.find(image.storage.get());
        return {.variable = variable,
                .resource = input != inputs_.end() ? input->second
                            : own.empty()          ? image.name
                                                   : own,
                .storage = image.storage.get(),
                .format = image.format,
                .extent = image.extent,
                .mips = image.mips,
                .first_mip = image.first_mip,
                .sampling = sampling,
                .is_input = own.empty()};
    }
    static UsedResource used(const Buffer& buffer) {
        return {
            .variable = buffer.name, .resource = buffer.name, .storage = buffer.storage.get(), .bytes = buffer.size};
    }
    UsedResource written_test(const Image& image) {
        written_.insert(image.storage.get());
        return used(image.name, image);
    }

    std::vector<std::byte> texels_of(const Image& image) {
        const FormatFacts& format = facts_of(image.format);
        const HostImage pixels = pass_list_.download(image);
        std::vector<std::byte> texels(pixels.pixel_count() * format.bytes);
        encode_texels(image.format, pixels.values, texels.data());
        return texels;
    }

    PassList& pass_list_;
    std::string compiled_text_;  ///< of the shader that was compiled last, until its pass runs
    const GlslChange change_{unique_name(), [this](const std::string& glsl) { return compiled_text_ = glsl; }};
    std::map<std::vector<unsigned>, std::string> texts_;  ///< by their SPIR-V
    std::map<const ImageStorage*, std::string> inputs_;   ///< images of this frame's G-buffer
    std::vector<FrameCommand> commands_;
    std::map<std::string, Image> read_;  ///< the technique's own images, by name
    std::set<const ImageStorage*> written_;
};

}  // namespace

FramePasses frame_passes(Device& device, const PointConfig& point, glm::uvec2 screen,
                         const std::vector<std::filesystem::path>& scene_path) {
    const Shot shot = load_shot(
        {.scene = "mirror_pillars", .extent = screen, .frames = {0}, .warm_up = 1, .direct_lit = true}, scene_path);
    const Renderer renderer(device, screen, point);
    if (renderer.technique->uses_scene_data())
        fail(point.technique, " ", point.point,
             " follows its rays through the scene on the CPU, so it cannot be exported; choose another tracer");
    const std::unique_ptr<FrameSource> source = scene_source(device, shot, timed_config({point}, 0), true);
    FrameStore store(*source, shot.config, 0);
    FramePasses passes{.screen = screen, .frames = {}, .fixed = {}, .result = {}};
    PassCollector collector(*renderer.pass_list);
    for (size_t i = 0; i < std::size(passes.frames); ++i) {
        const FrameStore::Frame frame = store.frame(shot.steps.at(i), {});
        collector.begin(frame.gbuffer);
        const Reflections result = renderer.render(frame.camera, point.seeds.front(), frame.gbuffer);
        passes.result = {renderer.pass_list->asked_name(result.radiance),
                         renderer.pass_list->asked_name(result.confidence), result.confidence_channel};
        renderer.pass_list->times();  // waits: the frame's images are gone with the next one
        passes.frames[i] = collector.take();
    }
    if (std::ranges::all_of(passes.frames[1], &FrameCommand::is_clear))
        fail(point.technique, " ", point.point,
             " has no passes of its own; choose a technique that has (see: ssrlab list techniques)");
    passes.fixed = collector.fixed_texels();
    return passes;
}
