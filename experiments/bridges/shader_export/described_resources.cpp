#include "experiments/bridges/shader_export/described_resources.h"

#include "core/files.h"
#include "core/own_files.h"
#include "experiments/bridges/shader_export/declared_comment.h"
#include "experiments/bridges/shader_export/screen_share.h"
#include "experiments/bridges/shader_export/vulkan_names.h"

#include <algorithm>

using nlohmann::json;

namespace {

const char* wrap_name(Wrap wrap) {
    constexpr const char* names[] = {"clamp to edge", "repeat", "mirrored repeat"};  // in the order of Wrap
    return names[size_t(wrap)];
}

/// Of the image's declaration in gbuffer.h, else in the shader.
std::string meaning_of(const FrameCommand& command, const UsedResource& input) {
    static const std::string gbuffer = read_text(own_files() / "core/gbuffer/gbuffer.h");
    const std::string of_gbuffer = declared_comment(gbuffer, input.resource), format = name_of(input.format) + ": ";
    if (of_gbuffer.starts_with(format)) return of_gbuffer.substr(format.size());
    return of_gbuffer.empty() ? declared_comment(command.glsl, input.variable) : of_gbuffer;
}

}  // namespace

std::string access_name(const ShaderResourceLayout& layout) {
    return layout.is_read && layout.is_written ? "read and write"
           : layout.is_read                    ? "read"
           : layout.is_written                 ? "write"
                                               : "none";
}

std::optional<unsigned> binding_of(const FrameCommand& command, const std::string& name) {
    for (const ShaderInterface::Resource& r : command.recipe.resources)
        if (r.name == name && !r.is_vertex) return r.binding;
    return {};
}

std::string DescribedResources::share_of(glm::uvec2 size, glm::uvec2 other_size) const {
    return share_text({frames_.screen, size, other_.screen, other_size});
}

json DescribedResources::image_use(const FrameCommand& command, const UsedResource& used, const UsedResource& other,
                                   const ShaderLayout& layout) {
    json use = {{"name", used.variable},
                {"resource", used.resource},
                {"format", vulkan_name(used.format)},
                {"size", {used.extent.x, used.extent.y}},
                {"share", share_of(used.extent, other.extent)}};
    if (used.first_mip > 0 || used.mips > 1) use["first_mip"] = used.first_mip, use["mips"] = used.mips;
    if (lives_.is_history(used.resource)) use["side"] = lives_.is_previous(used) ? "previous" : "current";
    if (const auto found = layout.resources.find(used.variable); found != layout.resources.end()) {
        const ShaderResourceLayout& declared = found->second;
        use["set"] = 0, use["binding"] = binding_of(command, used.variable).value();
        use["type"] = declared.type, use["access"] = access_name(declared);
        if (declared.type.find("sampler") != std::string::npos) {
            use["filter"] = used.sampling.is_linear ? "linear" : "nearest";
            use["wrap"] = {wrap_name(used.sampling.wrap_u), wrap_name(used.sampling.wrap_v)};
        }
        if (!declared.is_read && !declared.is_written) return use;
    }
    list_image(command, used, use);
    return use;
}

/// Once; of several mips the largest counts.
void DescribedResources::list_image(const FrameCommand& command, const UsedResource& used, const json& use) {
    json& list = used.is_input ? inputs : images;
    const unsigned mips = used.first_mip + used.mips;
    const auto known = std::ranges::find_if(list, [&](const json& one) { return one.at("name") == used.resource; });
    if (known != list.end()) {
        if (known->at("size").at(0) < use.at("size").at(0))
            (*known)["size"] = use.at("size"), (*known)["share"] = use.at("share");
        (*known)["mips"] = std::max(known->at("mips").get<unsigned>(), mips);
        return;
    }
    json image = {{"name", used.resource},
                  {"format", use.at("format")},
                  {"size", use.at("size")},
                  {"share", use.at("share")},
                  {"mips", mips}};
    if (used.is_input) {
        image["meaning"] = meaning_of(command, used);
    } else {
        image["is_history"] = lives_.is_history(used.resource);
        image["is_kept"] = lives_.is_history(used.resource) || lives_.is_kept(used.resource) ||
                           facts_.kept_images.contains(used.resource);
    }
    list.push_back(std::move(image));
}

json DescribedResources::buffer_use(const FrameCommand& command, const UsedResource& used, const UsedResource& other,
                                    const ShaderLayout& layout) {
    const std::string bytes = bytes_text({frames_.screen, used.bytes, other_.screen, other.bytes});
    if (std::ranges::none_of(buffers, [&](const json& known) { return known.at("name") == used.resource; }))
        buffers.push_back({{"name", used.resource},
                           {"bytes", used.bytes},
                           {"share", bytes},
                           {"is_kept", lives_.is_kept(used.resource)}});
    return {{"name", used.variable},
            {"resource", used.resource},
            {"set", 0},
            {"binding", binding_of(command, used.variable).value()},
            {"type", "buffer"},
            {"layout", "std430"},
            {"access", access_name(layout.resources.at(used.variable))},
            {"bytes", used.bytes},
            {"share", bytes}};
}

json DescribedResources::take_fixed_images() {
    json taken = json::array();
    for (const FixedTexels& fixed : frames_.fixed) {
        const auto image =
            std::ranges::find_if(images, [&](const json& one) { return one.at("name") == fixed.image.resource; });
        if (image == images.end()) continue;  // no shader reads it with these values
        json entry = *image;
        entry.erase("is_history"), entry.erase("is_kept");
        entry["file"] = fixed.image.resource + ".texels";
        taken.push_back(std::move(entry));
        images.erase(image);
    }
    return taken;
}
