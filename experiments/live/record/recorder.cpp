#include "experiments/live/record/recorder.h"

#include "core/error.h"
#include "experiments/live/record/texel_stream.h"
#include "experiments/report/image_encoding.h"

#include <cstring>

namespace {

using nlohmann::json;

/// As WebGL names them (facts_of() has OpenGL's names, which core keeps to itself).
std::string wrap_name(Wrap wrap) {
    return wrap == Wrap::clamp ? "CLAMP_TO_EDGE" : wrap == Wrap::repeat ? "REPEAT" : "MIRRORED_REPEAT";
}

std::string compare_name(DepthTest::Compare compare) {
    constexpr const char* names[] = {"LESS", "GREATER", "LEQUAL", "GEQUAL", "EQUAL", "ALWAYS"};
    return names[size_t(compare)];  // in the order of Compare
}

json words_of(const std::vector<std::byte>& bytes) {
    std::vector<uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), words.size() * 4);
    return words;
}

}  // namespace

size_t RecordedTexels::keep(json description, const std::vector<unsigned char>& bytes) {
    const auto [place, is_new] =
        places_.try_emplace(description.dump() + std::string(bytes.begin(), bytes.end()), texts_.size());
    if (is_new) descriptions_.push_back(std::move(description)), texts_.push_back(base64(bytes));
    return place->second;
}

size_t RecordedTexels::add(const HostImage& image) {
    const TexelStream stream = encode_floats(image);
    return keep({{"width", image.extent.x},
                 {"height", image.extent.y},
                 {"channels", image.channels},
                 {"shifts", stream.shifts}},
                stream.bytes);
}

size_t RecordedTexels::add_rounded(const HostImage& rgb, unsigned significand_bits) {
    size_t clamped = 0;
    const std::vector<unsigned char> bytes = encode_halves(rgb, clamped, significand_bits);
    return keep({{"width", rgb.extent.x}, {"height", rgb.extent.y}, {"significand_bits", significand_bits}}, bytes);
}

Recorder::Recorder(PassList& pass_list, RecordedTexels& texels, KnownReads& reads, bool keeps_passes)
    : pass_list_(pass_list), texels_(texels), known_reads_(reads), keeps_passes_(keeps_passes) {}
Recorder::~Recorder() { stop(); }

void Recorder::stop() {
    pass_list_.watch(nullptr);
    if (keeps_passes_) pass_list_.observe({});
}

void Recorder::begin_frame(const GBuffer& gbuffer) {
    commands_ = json::array(), inputs_ = json::object();
    inputs_now_.clear();
    for (const Image& image : gbuffer.images()) inputs_now_.try_emplace(image.storage.get(), image.name);
    if (keeps_passes_)
        pass_list_.observe([this](const std::string& stage, std::span<const Image> written) {
            for (const Image& image : written)
                commands_.push_back({{"check", {image_of(image), image.first_mip}},
                                     {"stage", stage},
                                     {"texels", texels_.add(pass_list_.download(image))}});
        });
    pass_list_.watch(this);
}

void Recorder::cleared(const Image& image, glm::vec4 value) {
    for (unsigned mip = 0; mip < image.mips; ++mip)
        commands_.push_back(
            {{"clear", {image_of(image), image.first_mip + mip}}, {"value", {value.x, value.y, value.z, value.w}}});
}

void Recorder::uploaded(const Image& image) {
    const size_t place = image_of(image);
    commands_.push_back({{"upload", place}, {"texels", texels_.add(pass_list_.download(image))}});
}

json Recorder::end_frame(const Reflections& reflections) {
    stop();
    const auto [place, is_new] = list_places_.try_emplace(commands_.dump(), lists_.size());
    if (is_new) lists_.push_back(commands_);
    return {{"commands", place->second},
            {"inputs", inputs_},
            {"radiance", texture_of(reflections.radiance)},
            {"confidence", texture_of(reflections.confidence)},
            {"confidence_channel", reflections.confidence_channel}};
}

size_t Recorder::described(const Image& image, const std::string& name) {
    const WholeImage whole = whole_of(image);
    images_.push_back({{"name", name},
                       {"format", name_of(image.format)},
                       {"width", whole.extent.x},
                       {"height", whole.extent.y},
                       {"mips", whole.mips}});
    return images_.size() - 1;
}

size_t Recorder::image_of(const Image& image) {
    const auto known = known_.find(image.storage.get());
    if (known != known_.end()) return known->second;
    kept_.push_back(image);
    const std::string asked = pass_list_.asked_name(image);
    const size_t place = described(image, asked.empty() ? image.name : asked);
    known_[image.storage.get()] = place;
    return place;
}

/// What no command has written is an input of the frame, or of all frames.
size_t Recorder::texture_of(const Image& image) {
    if (known_.contains(image.storage.get())) return image_of(image);
    const auto input = inputs_now_.find(image.storage.get());
    if (input == inputs_now_.end()) {
        const size_t place = image_of(image);
        images_[place]["texels"] = texels_.add(pass_list_.download(image));
        return place;
    }
    const auto [place, is_new] = input_places_.try_emplace(input->second, images_.size());
    if (is_new) described(image, input->second);
    const std::string key = std::to_string(place->second);
    if (!inputs_.contains(key)) inputs_[key] = texels_.add(pass_list_.download(image));
    return place->second;
}

size_t Recorder::program_of(const PassRun& pass) {
    const auto [vertex, fragment, files] =
        webgl2_sources(pass.shader, shader_prelude(pass.params, ShaderLanguage::webgl2), pass.includes);
    const auto [place, is_new] = program_places_.try_emplace(fragment, programs_.size());
    vertex_ = vertex;
    if (is_new) {
        programs_.push_back({{"stage", pass.stage}, {"fragment", fragment}});
        const auto [reads, is_unknown] = known_reads_.try_emplace(fragment);
        if (is_unknown) reads->second = reads_of(pass.recipe);
        reads_.push_back(&reads->second);
        params_read_.insert(reads->second.params.begin(), reads->second.params.end());
    }
    return place->second;
}

std::optional<InstrumentedPipeline> Recorder::before(const PassRun& pass) {
    if (pass.recipe.is_compute || pass.draws_meshes)
        fail("pass ", pass.stage, " cannot be recorded: it is no fragment shader over a whole image");
    if (!pass.constants.empty())
        fail("pass ", pass.stage, " cannot be recorded: it sets constants that the shader's source does not hold");
    const size_t program = program_of(pass);
    json command = {{"program", program}, {"textures", json::array()}, {"targets", json::array()}};
    for (const PassRun::BoundImage& texture : pass.samplers)
        if (reads_[program]->samplers.contains(texture.name))
            command["textures"].push_back({texture.name, texture_of(texture.image),
                                           texture.sampling.is_linear ? "LINEAR" : "NEAREST",
                                           wrap_name(texture.sampling.wrap_u), wrap_name(texture.sampling.wrap_v)});
    for (const Image& target : pass.targets) command["targets"].push_back({image_of(target), target.first_mip});
    if (!pass.push.empty()) command["push"] = words_of(pass.push);
    if (pass.depth.image.storage)
        command["depth"] = {image_of(pass.depth.image), compare_name(pass.depth.compare), pass.depth.is_written};
    if (pass.stencil.mode != Stencil::Mode::off)
        command["stencil"] = {image_of(pass.stencil.image), pass.stencil.mode == Stencil::Mode::write,
                              pass.stencil.value};
    commands_.push_back(std::move(command));
    return {};
}
