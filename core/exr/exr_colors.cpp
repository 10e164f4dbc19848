#include "core/exr/exr_colors.h"

#include "core/error.h"

namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const Chromaticities& c) {
    const auto place = [](glm::dvec2 xy) {
        std::ostringstream text;
        text << "(" << xy.x << ", " << xy.y << ")";
        return text.str();
    };
    fail(file.string(), ": its attribute 'chromaticities' spans no colours: red ", place(c.red), ", green ",
         place(c.green), ", blue ", place(c.blue), ", white ", place(c.white),
         "; remove the attribute if the colours are linear Rec. 709");
}

}  // namespace

std::string convert_to_rec709(const std::filesystem::path& file, const ExrPart& part, HostImage& rgb) {
    if (!part.chromaticities || is_rec709(*part.chromaticities)) return "";
    const auto matrix = rec709_from(*part.chromaticities);
    if (!matrix) refuse(file, *part.chromaticities);
    const glm::mat3 to_rec709(*matrix);
    for (size_t i = 0; i < rgb.pixel_count(); ++i) rgb.set_rgb(i, to_rec709 * rgb.rgb(i));
    return file.string() + ": its colours are converted from " + name_of(*part.chromaticities) +
           " to Rec. 709, by its attribute 'chromaticities'.";
}

glm::dvec3 luminance_weights(const std::filesystem::path& file, const ExrPart& part) {
    const Chromaticities& space = part.chromaticities ? *part.chromaticities : rec709_chromaticities;
    const auto xyz = xyz_from(space);
    if (!xyz) refuse(file, space);
    const glm::dvec3 y((*xyz)[0].y, (*xyz)[1].y, (*xyz)[2].y);
    return y / (y.x + y.y + y.z);
}
