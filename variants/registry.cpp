#include "variants/registry.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "variants/mcguire_dda/mcguire_dda.h"
#include "variants/none/none.h"

namespace {

template <class T>
std::unique_ptr<Variant> create() {
    return std::make_unique<T>();
}

const std::vector<VariantEntry> table = {
    {
        .name = "none",
        .title = "No screen-space reflections",
        .source = "ssrlab",
        .description = "Confidence 0 everywhere: the fallback alone, against which every technique is read.",
        .needs = {},
        .presets = {},
        .create = create<None>,
    },
    {
        .name = "mcguire_dda",
        .title = "Screen-space ray tracing by a perspective-correct DDA",
        .source = "McGuire & Mara 2014, Efficient GPU Screen-Space Ray Tracing, JCGT 3(4)",
        .description = "One mirror ray per pixel, walked pixel by pixel along its line on the screen until it passes "
                       "behind a surface.",
        .needs = {"has_reflective", "min_roughness"},
        .presets = {{"published",
                     "the first interval starts at the ray's origin, as in the paper",
                     {{"interval_from_origin", true}}},
                    {"coarse",
                     "every fourth pixel, dithered, with the authors' refinement",
                     {{"stride", 4}, {"checkerboard", true}, {"refine", true}}},
                    {"any_scale",
                     "thickness as a share of the depth, for scenes of any size",
                     {{"thickness", 0.0}, {"relative_thickness", 0.02}}}},
        .create = create<McGuireDda>,
    },
};

template <class T>
const T& find_named(std::span<const T> entries, const std::string& name, const std::string& what) {
    std::vector<std::string> names;
    for (const T& entry : entries) {
        if (entry.name == name) return entry;
        names.push_back(entry.name);
    }
    if (names.empty()) fail("unknown ", what, " '", name, "'; there are none");
    fail("unknown ", what, " '", name, "'", suggestion(name, names));
}

}  // namespace

std::span<const VariantEntry> variant_table() { return table; }

const VariantEntry& find_variant(const std::string& name) { return find_named<VariantEntry>(table, name, "variant"); }

std::unique_ptr<Variant> make_variant(const std::string& name, const nlohmann::json& parameters,
                                      const std::string& preset) {
    const VariantEntry& entry = find_variant(name);
    std::unique_ptr<Variant> variant = entry.create();
    if (!preset.empty())
        variant->params.assign(
            find_named<Preset>(entry.presets, preset, "preset of variant '" + name + "':").parameters);
    try {
        if (!parameters.is_null()) variant->params.assign(parameters);
    } catch (const Error& error) {
        fail("variant '", name, "': ", error.what());
    }
    return variant;
}
