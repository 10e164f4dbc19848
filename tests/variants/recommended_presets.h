#pragma once
#include "variants/registry.h"

#include <string>
#include <vector>

/// Whether pages recommend the preset: `corrected` repairs an original, and a search found the others.
inline bool is_recommended(const Preset& preset) {
    return preset.name == "corrected" || preset.name.starts_with("best") || preset.name.starts_with("rooms_");
}

/// All of ssrlab's own techniques, as NAME:PRESET.
inline std::vector<std::string> recommended_presets() {
    std::vector<std::string> names;
    for (const TechniqueEntry& entry : technique_table())
        if (entry.is_ssrlabs())  // not of another test of this process
            for (const Preset& preset : entry.presets)
                if (is_recommended(preset)) names.push_back(entry.name + ":" + preset.name);
    return names;
}
