#include "core/gbuffer/gbuffer_formats.h"

PassChanges gbuffer_changes(GBufferFormats formats) {
    if (formats == GBufferFormats::exact) return {};
    static const std::map<std::string, Format> packed = {{"geometric_normal", Format::rgba16f},
                                                         {"normal", Format::rgba16f},
                                                         {"previous_normal", Format::rgba16f},
                                                         {"base_color", Format::rgba8},
                                                         {"dielectric_f0", Format::rgba16f},
                                                         {"emission", Format::rgba16f},
                                                         {"motion", Format::rg16f},
                                                         {"lit", Format::rgba16f},
                                                         {"lit_without_specular", Format::rgba16f},
                                                         {"fallback", Format::rgba16f}};
    return {.format_of =
                [](const std::string& image, Format asked) {
                    const auto found = packed.find(image);
                    return found == packed.end() ? asked : found->second;
                },
            .glsl_of = {}};
}
