#include "core/scene/gltf/gltf_parts.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/unique_names.h"

#include <algorithm>
#include <map>
#include <optional>

namespace {
using Property = AnimationChannel::Property;

/// What a channel moves: a property of a node of the scene, or what ssrlab leaves as it is.
struct Target {
    int node = -1;       ///< index into Scene::nodes; -1: nothing that is shown
    std::string path;    ///< "translation", "rotation", "scale", "weights", or another
    std::string beside;  ///< not empty: what moves of the node, by the names of the file, and stands still here

    std::optional<Property> property() const {
        if (path == "translation") return Property::translation;
        if (path == "rotation") return Property::rotation;
        if (path == "scale") return Property::scale;
        if (path == "weights") return Property::weight;
        return {};
    }
};

/// "/nodes/3/translation" of KHR_animation_pointer as (3, "translation"). Of other pointers nothing is shown, as
/// say_what_is_left_out() says.
Target pointed_at(const GltfFile& file, const std::string& pointer, const std::vector<int>& node_of,
                  const std::string& what) {
    const std::string nodes = "/nodes/";
    const size_t slash = pointer.find('/', nodes.size());
    const std::string number = pointer.substr(std::min(nodes.size(), pointer.size()), slash - nodes.size());
    const bool is_number = !number.empty() && number.size() < 9 &&
                           std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
    Target target{.node = -1, .path = slash == std::string::npos ? "" : pointer.substr(slash + 1), .beside = ""};
    if (!pointer.starts_with(nodes) || !is_number || !target.property()) return {};
    target.node = node_of[checked_index(file, std::stoi(number), node_of.size(), what + ": node")];
    return target;
}

Target target_of(const GltfFile& file, const tinygltf::AnimationChannel& channel, const std::vector<int>& node_of,
                 const std::string& what) {
    const auto extension = channel.target_extensions.find("KHR_animation_pointer");
    if (channel.target_path == "pointer" && extension != channel.target_extensions.end())
        return pointed_at(file, extension->second.Get("pointer").Get<std::string>(), node_of, what);
    Target target{.node = -1, .path = channel.target_path, .beside = ""};
    if (channel.target_node < 0) return target;  // of an extension; glTF 2.0, section 3.11: to be ignored
    target.node = node_of[checked_index(file, channel.target_node, node_of.size(), what + ": node")];
    if (!target.property()) target.beside = channel.target_path;
    return target;
}

Interpolation interpolation(const std::string& name) {
    if (name == "STEP") return Interpolation::step;
    return name == "LINEAR" ? Interpolation::linear : Interpolation::cubic_spline;
}

/// Appends the channel of a property, or one for each weight of the node's morph targets.
void add_channels(const GltfFile& file, const tinygltf::AnimationSampler& sampler, const Target& target,
                  const std::string& what, Scene& scene) {
    const Property property = *target.property();
    AnimationChannel channel{.property = property, .node = unsigned(target.node)};
    channel.interpolation = interpolation(sampler.interpolation);
    channel.times = read_floats(file, sampler.input, 1, what + " times");
    if (channel.times.empty()) fail(file.name(), ": ", what, " has no keys");
    if (std::ranges::adjacent_find(channel.times, std::greater_equal<>{}) != channel.times.end())
        fail(file.name(), ": ", what, ": the times of its keys do not ascend");
    // Weights are scalars, those of one key side by side (glTF 2.0, section 3.11).
    const bool is_weights = property == Property::weight;
    const size_t channels = is_weights ? scene.nodes[channel.node].weights.size() : 1;
    const unsigned components = is_weights ? 1 : property == Property::rotation ? 4 : 3;
    const std::vector<float> values = read_floats(file, sampler.output, components, what + " values");
    const size_t per_key = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
    if (values.size() != channel.times.size() * per_key * components * channels)
        fail(file.name(), ": ", what, " has ", channel.times.size(), " keys and ", values.size() / components,
             " values", is_weights ? " of " + std::to_string(channels) + " morph targets" : "");
    scene.memory.add(
        double(channels) * double(channel.times.size()) * double(sizeof(float) + per_key * sizeof(glm::vec4)),
        file.name() + ": " + what);
    for (size_t target_index = 0; target_index < channels; ++target_index) {
        AnimationChannel& added = scene.animation.emplace_back(channel);
        added.target = unsigned(target_index);
        for (size_t i = target_index * components; i < values.size(); i += components * channels)
            added.values.emplace_back(values[i], is_weights ? 0.0f : values[i + 1], is_weights ? 0.0f : values[i + 2],
                                      components == 4 ? values[i + 3] : 0.0f);
    }
}

/// Whether no two animations move the same property of the same node.
bool are_disjoint(const std::vector<std::vector<Target>>& targets) {
    std::map<std::pair<int, Property>, size_t> first;
    for (size_t i = 0; i < targets.size(); ++i)
        for (const Target& target : targets[i])
            if (target.node >= 0 && target.property() &&
                first.try_emplace({target.node, *target.property()}, i).first->second != i)
                return false;
    return true;
}

std::string quoted_names(const std::vector<AnimationClip>& clips) {
    constexpr size_t most_names = 6;
    std::string names;
    for (size_t i = 0; i < std::min(clips.size(), most_names); ++i)
        names += (i ? ", '" : "'") + shortened(clips[i].name) + "'";
    return names + (clips.size() > most_names ? ", ..." : "");
}

/// Marks those that are played; says so where the file had to be asked (load_gltf.h).
void choose(GltfFile& file, const std::vector<std::vector<Target>>& targets, const std::string& wanted,
            std::vector<AnimationClip>& clips) {
    const auto named = std::ranges::find(clips, wanted, &AnimationClip::name);
    if (named != clips.end()) {
        named->is_played = true;
        return;
    }
    if (clips.empty() || wanted == "none") return;
    const bool all = wanted == "all" || are_disjoint(targets);
    for (AnimationClip& clip : clips) clip.is_played = all || &clip == &clips.front();
    if (clips.size() == 1 || wanted == "all") return;
    const std::string choosing = " \"animation\" in a scene.json, or --animation, chooses.";
    file.warn(all ? "All " + std::to_string(clips.size()) + " animations (" + quoted_names(clips) +
                        ") are played together, as no two move the same property of a node;" + choosing
                  : "Animation '" + shortened(clips.front().name) + "' is played, the first of " +
                        std::to_string(clips.size()) + " (" + quoted_names(clips) + ");" + choosing);
}
}  // namespace

void add_animation(GltfFile& file, const std::vector<int>& node_of, const std::string& wanted, Scene& scene) {
    const auto& animations = file.model.animations;
    for (size_t i = 0; i < animations.size(); ++i)
        scene.clips.push_back(
            {.name = animations[i].name.empty() ? "animation_" + std::to_string(i) : animations[i].name});
    make_names_unique(scene.clips);
    const auto what = [&](size_t animation, size_t channel) {
        return "animation '" + shortened(scene.clips[animation].name) + "' channel " + std::to_string(channel);
    };
    std::vector<std::vector<Target>> targets(animations.size());
    for (size_t i = 0; i < animations.size(); ++i)
        for (size_t k = 0; k < animations[i].channels.size(); ++k)
            targets[i].push_back(target_of(file, animations[i].channels[k], node_of, what(i, k)));
    choose(file, targets, wanted, scene.clips);
    for (size_t i = 0; i < animations.size(); ++i) {
        if (!scene.clips[i].is_played) continue;
        for (size_t k = 0; k < animations[i].channels.size(); ++k) {
            const Target& target = targets[i][k];
            if (!target.beside.empty())
                file.warn("Animation '" + shortened(scene.clips[i].name) + "' also moves '" + shortened(target.beside) +
                          "', which ssrlab does not move.");
            if (target.node < 0 || !target.property()) continue;  // outside the scene that is shown
            if (target.property() == Property::weight && scene.nodes[size_t(target.node)].weights.empty()) continue;
            const auto& samplers = animations[i].samplers;
            const size_t sampler =
                checked_index(file, animations[i].channels[k].sampler, samplers.size(), what(i, k) + ": sampler");
            add_channels(file, samplers[sampler], target, what(i, k), scene);
        }
    }
}
