#include "core/scene/gltf/gltf_parts.h"

#include "core/error.h"

#include <algorithm>

namespace {
using Property = AnimationChannel::Property;

Interpolation interpolation(const GltfFile& file, const std::string& name) {
    if (name == "STEP") return Interpolation::step;
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
    fail(file.name(), ": unknown interpolation '", name, "'; allowed are STEP, LINEAR and CUBICSPLINE");
}

AnimationChannel read_channel(const GltfFile& file, const tinygltf::AnimationSampler& sampler, Property property,
                              const std::string& what) {
    AnimationChannel channel;
    channel.property = property;
    channel.interpolation = interpolation(file, sampler.interpolation);
    channel.times = read_floats(file, sampler.input, 1, what + " times");
    if (channel.times.empty()) fail(file.name(), ": ", what, " has no keys");
    if (std::ranges::adjacent_find(channel.times, std::greater_equal<>{}) != channel.times.end())
        fail(file.name(), ": ", what, ": the times of its keys do not ascend");
    const unsigned components = property == Property::rotation ? 4 : 3;
    const std::vector<float> values = read_floats(file, sampler.output, components, what + " values");
    const size_t per_key = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
    if (values.size() != channel.times.size() * per_key * components)
        fail(file.name(), ": ", what, " has ", channel.times.size(), " keys and ", values.size() / components,
             " values");
    for (size_t i = 0; i < values.size(); i += components)
        channel.values.emplace_back(values[i], values[i + 1], values[i + 2], components == 4 ? values[i + 3] : 0.0f);
    return channel;
}
}  // namespace

void add_animation(GltfFile& file, const std::vector<int>& node_of, Scene& scene) {
    for (const auto& animation : file.model.animations)
        for (size_t i = 0; i < animation.channels.size(); ++i) {
            const auto& channel = animation.channels[i];
            const std::string what = "animation '" + animation.name + "' channel " + std::to_string(i);
            if (channel.target_path == "weights") {
                file.warn("The animated morph weights of animation '" + animation.name + "' are ignored.");
                continue;
            }
            if (channel.target_node < 0) continue;  // of an extension; glTF 2.0, section 3.11: to be ignored
            const int node = node_of[checked_index(file, channel.target_node, node_of.size(), what + ": node")];
            if (node < 0) continue;  // outside the scene that is shown
            const auto& sampler =
                animation.samplers[checked_index(file, channel.sampler, animation.samplers.size(), what + ": sampler")];
            const std::string& path = channel.target_path;
            if (path != "translation" && path != "rotation" && path != "scale") {
                file.warn("The animated property '" + path + "' of animation '" + animation.name +
                                     "' is ignored.");
                continue;
            }
            const Property property = path == "rotation" ? Property::rotation
                                      : path == "scale"  ? Property::scale
                                                         : Property::translation;
            scene.animation.push_back(read_channel(file, sampler, property, what));
            scene.animation.back().node = unsigned(node);
        }
}
