#include "core/exr/exr_layers.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace {

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

/// What the last part of a channel's name stands for; none if it is no component.
std::optional<char> letter_of(const std::string& component) {
    if (component.size() == 1) return char(std::toupper(static_cast<unsigned char>(component[0])));
    constexpr std::pair<std::string_view, char> words[] = {{"red", 'R'}, {"green", 'G'}, {"blue", 'B'}, {"alpha", 'A'}};
    for (const auto& [word, letter] : words)
        if (lower(component) == word) return letter;
    if (component == "RY" || component == "BY") return '~';  // chroma, which no letter stands for
    return {};
}

/// RGBA and XYZ before all else, so that an interleaved image has the order which its user expects.
int rank_of(const ExrComponent& component) {
    const size_t rank = std::string_view("RGBAXYZ").find(component.letter);
    return rank == std::string_view::npos ? 1000 + component.letter : int(rank);
}

std::string name_in_file(const ExrHeader& header, const ExrLayer& layer) {
    const std::string& part = header.parts[layer.part].name;
    if (header.parts.size() == 1 || part.empty() || layer.in_part == part || layer.in_part.starts_with(part + "."))
        return layer.in_part;
    return layer.in_part.empty() ? part : part + "." + layer.in_part;
}

}  // namespace

const ExrComponent* ExrLayer::find(std::string_view component) const {
    const auto found = std::ranges::find(components, component, &ExrComponent::name);
    return found == components.end() ? nullptr : &*found;
}

std::vector<ExrLayer> layers_of(const ExrHeader& header) {
    std::vector<ExrLayer> layers;
    std::map<std::pair<size_t, std::string>, size_t> places;
    for (size_t part = 0; part < header.parts.size(); ++part)
        for (size_t channel = 0; channel < header.parts[part].channels.size(); ++channel) {
            const std::string& name = header.parts[part].channels[channel].name;
            const size_t dot = name.rfind('.');
            const std::string last = dot == std::string::npos ? name : name.substr(dot + 1);
            const auto letter = letter_of(last);
            const std::string layer = !letter ? name : dot == std::string::npos ? "" : name.substr(0, dot);
            const auto [place, is_new] = places.try_emplace({part, layer}, layers.size());
            if (is_new) layers.push_back({.name = {}, .in_part = layer, .part = part, .components = {}});
            layers[place->second].components.push_back(
                {.channel = channel, .name = letter ? last : "", .letter = letter.value_or('Y')});
        }
    for (ExrLayer& layer : layers) {
        std::ranges::stable_sort(layer.components, {}, rank_of);
        layer.name = name_in_file(header, layer);
    }
    return layers;
}

const ExrLayer* find_layer(const ExrHeader& header, const std::vector<ExrLayer>& layers, const std::string& name) {
    const auto part = [&](const ExrLayer& layer) -> const ExrPart& { return header.parts[layer.part]; };
    const auto matches = {
        +[](const ExrPart&, const ExrLayer& layer, const std::string& wanted) { return layer.name == wanted; },
        +[](const ExrPart& p, const ExrLayer& layer, const std::string& wanted) {
            return layer.in_part.empty() && !wanted.empty() && (p.name == wanted || p.view == wanted);
        },
        +[](const ExrPart& p, const ExrLayer& layer, const std::string& wanted) {
            return layer.in_part == wanted || p.name + "." + layer.in_part == wanted;
        }};
    for (const auto& is_meant : matches)
        for (const ExrLayer& layer : layers)
            if (is_meant(part(layer), layer, name)) return &layer;
    return nullptr;
}

std::optional<std::vector<ExrComponent>> components_named(const ExrLayer& layer, std::string_view letters) {
    std::vector<ExrComponent> found;
    for (const char letter : letters) {
        const ExrComponent* best = nullptr;
        const auto rank = [&](const ExrComponent& c) { return c.name.size() > 1 ? 2 : c.name[0] == letter ? 0 : 1; };
        for (const ExrComponent& component : layer.components)
            if (!component.name.empty() && component.letter == letter && (!best || rank(component) < rank(*best)))
                best = &component;
        if (!best) return {};
        found.push_back(*best);
    }
    return found;
}

std::string shown(const ExrLayer& layer) {
    std::string names;
    for (const ExrComponent& component : layer.components)
        if (!component.name.empty()) names += (names.empty() ? "" : " ") + component.name;
    if (layer.name.empty()) return names + " without a layer's name";
    return "'" + layer.name + "'" + (names.empty() ? "" : " (" + names + ")");
}

std::string shown(const std::vector<ExrLayer>& layers) {
    constexpr size_t most = 20;
    std::string text;
    for (size_t i = 0; i < std::min(most, layers.size()); ++i) text += (i ? ", " : "") + shown(layers[i]);
    if (layers.size() > most) text += " and " + std::to_string(layers.size() - most) + " more";
    return text;
}
