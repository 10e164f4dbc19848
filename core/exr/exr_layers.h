#pragma once
#include "core/exr/exr_header.h"

#include <string_view>

/// A channel within its layer.
struct ExrComponent {
    size_t channel = 0;  ///< index into ExrPart::channels
    std::string name;    ///< what follows the layer's name: "R", "red", "RY"; "" where the channel is a layer by itself
    char letter = 'Y';   ///< what `name` stands for, as a capital: 'R' of "R", "r", "red"; of a longer name 'Y'
};

/// Channels of one part that belong together. A channel's name is LAYER.COMPONENT, split at the last dot (OpenEXR,
/// "Technical Introduction", "Layers"); without a dot it belongs to the layer "". A component is a single letter, the
/// name of a colour, or RY or BY; any other name, as "AO" or "forward.speed", is a layer by itself.
struct ExrLayer {
    std::string name;     ///< as it is asked for: in files of several parts with the part's name before it
    std::string in_part;  ///< without the part's name
    size_t part = 0;      ///< index into ExrHeader::parts
    std::vector<ExrComponent> components;

    const ExrComponent* find(std::string_view component) const;  ///< by name; nullptr if there is none
};

/// All layers in the order of the file, with their components in the order RGBA, XYZ, else alphabetical.
std::vector<ExrLayer> layers_of(const ExrHeader& header);

/// The layer of that name, else the first whose part, view or name within its part is `name`. nullptr if there is none.
const ExrLayer* find_layer(const ExrHeader& header, const std::vector<ExrLayer>& layers, const std::string& name);

/// The layer's components for the letters, in their order. A capital is preferred to a small letter, and this to a
/// word. None if a component is missing.
std::optional<std::vector<ExrComponent>> components_named(const ExrLayer& layer, std::string_view letters);

/// "'ViewLayer.Combined' (R G B A)"; the layer without a name is "R G B without a layer's name".
std::string shown(const ExrLayer& layer);
/// The layers as a list; of many layers only the first.
std::string shown(const std::vector<ExrLayer>& layers);
