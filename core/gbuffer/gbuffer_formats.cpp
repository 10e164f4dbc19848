#include "core/gbuffer/gbuffer_formats.h"

#include "core/gbuffer/gbuffer_images.h"

PassChanges gbuffer_changes(GBufferFormats formats) {
    if (formats == GBufferFormats::exact) return {};
    static const std::map<std::string, Format> packed = [] {
        std::map<std::string, Format> formats = {{"lit_without_specular", Format::rgba16f}};
        for (const GBufferImage& image : gbuffer_images())
            if (image.packed != image.exact) formats[image.name] = image.packed;
        return formats;
    }();
    return {.format_of =
                [](const std::string& image, Format asked) {
                    const auto found = packed.find(image);
                    return found == packed.end() ? asked : found->second;
                },
            .glsl_of = {}};
}
