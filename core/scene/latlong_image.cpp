#include "core/scene/latlong_image.h"

#include "core/error.h"
#include "core/exr/radiance_file.h"
#include "core/scene/ranges.h"

#include <algorithm>
#include <cmath>

namespace fs = std::filesystem;

namespace {

/// What an image may be by its sides, and a command that makes one in latitude and longitude of it: by OpenEXR's and
/// the pfstools' programs.
std::string conversion_of(glm::uvec2 extent) {
    const unsigned x = extent.x, y = extent.y;
    const auto width = [](unsigned side) { return std::to_string(4 * side); };  // a face spans 90 degrees
    if (y == 6 * x)
        return "a cube map of OpenEXR, six faces one below the other: `exrenvmap -l -ci -w " + width(x) +
               " cube.exr latlong.exr` converts it";
    if (x == y)
        return "an angular map (light probe): `pfsin probe.exr | pfspanoramic angular+polar -i -w " +
               std::to_string(2 * x) +
               " | pfsout latlong.exr` converts it; or a map of equal areas, as pbrt-v4 has them: give the image that "
               "`imgtool makeequiarea` made it from";
    if (x == 6 * y || 3 * x == 4 * y || 4 * x == 3 * y || 2 * x == 3 * y || 3 * x == 2 * y)
        return "the six faces of a cube side by side or as a cross: cut them out as face+X.exr, face-X.exr, "
               "face+Y.exr, "
               "face-Y.exr, face+Z.exr and face-Z.exr, and `exrenvmap -l -w " +
               width(std::max(x, y) / (x == 6 * y ? 6 : 4)) + " face%.exr latlong.exr` converts them";
    return "another projection, or a part of a panorama: pad a part with what lies beyond it";
}

/// Sides are whole pixels, and programs crop or double the column where a panorama closes: one pixel. One percent
/// more turns no direction by more than 1.8 degrees.
bool is_latlong(glm::uvec2 extent) {
    const double width = extent.x, twice_height = 2.0 * extent.y;
    return std::abs(width - twice_height) <= 1 + 0.01 * width;
}

}  // namespace

HostImage read_latlong(const fs::path& file, float scale, std::vector<std::string>& notes) {
    HostImage image = read_radiance(file, "", notes);
    if (!is_latlong(image.extent))
        fail(file.string(),
             ": an environment is an image in latitude and longitude, twice as wide as high, but this one has ",
             image.extent.x, " x ", image.extent.y, " pixels; it may be ", conversion_of(image.extent));
    size_t outside = 0;
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        glm::vec3 color = image.rgb(i) * scale;
        const bool is_light = glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)) >= 0.0f;  // luminance of Rec. 709
        if (is_light && std::min({color.x, color.y, color.z}) < 0.0f) color = glm::max(color, 0.0f), ++outside;
        for (int c = 0; c < 3; ++c)
            if (!(color[c] >= 0.0f && color[c] <= any_radiance))
                fail(file.string(),
                     ": an environment must be finite and not negative, but a texel times its 'scale' is ", color[c],
                     "; allowed is [0, ", any_radiance, "]");
        image.set_rgb(i, color);
    }
    if (outside > 0)
        notes.push_back(
            file.string() + ": " + std::to_string(outside) +
            " texels have a colour outside of Rec. 709, a part of which is negative; 0 is taken for that part.");
    return image;
}
