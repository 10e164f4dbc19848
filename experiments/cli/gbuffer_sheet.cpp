#include "experiments/cli/gbuffer_sheet.h"

#include "core/png.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace {

constexpr unsigned most_sheet_width = 320, sheet_columns = 3, sheet_gap = 4, sheet_label_height = 14,
                   sheet_letter_scale = 2;

/// Capital letters of 3 x 5 pixels: five octal digits, a row each from the top, whose highest bit is the left
/// pixel.
constexpr std::array<uint16_t, 26> sheet_letters = {
    025755, 065656, 034443, 065556, 074647, 074644, 034553, 055755, 072227, 011152, 055655, 044447, 057755,
    065555, 025552, 065644, 025563, 065655, 034216, 072222, 055557, 055552, 055775, 055255, 055222, 071247};

/// Of a narrow picture only the label's beginning, up to the column `end`.
void write_sheet_label(HostImage& sheet, glm::uvec2 at, std::string_view text, unsigned end) {
    for (size_t n = 0; n < text.size(); ++n)
        for (unsigned y = 0; y < 5 * sheet_letter_scale; ++y)
            for (unsigned x = 0; x < 3 * sheet_letter_scale; ++x) {
                const glm::uvec2 place = at + glm::uvec2(unsigned(n) * 4 * sheet_letter_scale + x, y);
                if (text[n] < 'a' || text[n] > 'z' || place.x >= end) continue;
                const unsigned bit = 14 - (y / sheet_letter_scale * 3 + x / sheet_letter_scale);
                if (sheet_letters[size_t(text[n] - 'a')] >> bit & 1)
                    sheet.set_rgb(size_t(place.y) * sheet.extent.x + place.x, glm::vec3(0));
            }
}

glm::vec3 light_of(glm::vec3 code) {
    return {linear_from_srgb(code.x), linear_from_srgb(code.y), linear_from_srgb(code.z)};
}

/// Colours that differ for the first materials, and repeat far apart: hues by the golden ratio.
glm::vec3 sheet_material_color(float id) {
    const float hue = 6.0f * std::fmod(0.61803399f * id, 1.0f);
    const auto channel = [&](float from) {
        return std::clamp(std::abs(std::fmod(hue + from, 6.0f) - 3.0f) - 1.0f, 0.0f, 1.0f);
    };
    return light_of(0.3f + 0.7f * glm::vec3(channel(0), channel(4), channel(2)));
}

struct SheetPicture {
    std::string_view label;
    bool is_light;  ///< also where nothing was hit
    std::function<glm::vec3(size_t)> color;
};

}  // namespace

HostImage gbuffer_sheet(const HostGBuffer& gbuffer) {
    const float gain = std::exp2(gbuffer.exposure_ev);
    const auto is_hit = [&](size_t i) { return gbuffer.material_id.values[i] > 0; };
    const bool is_reversed = gbuffer.camera.depth.w > 0.5f;
    const auto nearness = [&](size_t i) {  // to first order, the nearest distance over the distance
        return is_reversed ? gbuffer.depth.values[i] : 1 - gbuffer.depth.values[i];
    };
    float most_near = 1e-12f, most_motion = 1e-6f;
    for (size_t i = 0; i < gbuffer.depth.pixel_count(); ++i)
        if (is_hit(i)) {
            most_near = std::max(most_near, nearness(i));
            for (unsigned c = 0; c < 2; ++c)
                most_motion = std::max(most_motion, std::abs(gbuffer.motion.values[2 * i + c]));
        }
    const auto fourth = [](const HostImage& image, size_t i) { return glm::vec3(image.values[4 * i + 3]); };
    const std::vector<SheetPicture> pictures = {
        {"light", true,
         [&](size_t i) { return gbuffer.lit.values.empty() ? glm::vec3(0) : gbuffer.lit.rgb(i) * gain; }},
        {"base color", false, [&](size_t i) { return gbuffer.base_color.rgb(i); }},
        {"emission", false, [&](size_t i) { return gbuffer.emission.rgb(i) * gain; }},
        {"nearness", false, [&](size_t i) { return light_of(glm::vec3(nearness(i) / most_near)); }},
        {"normal", false, [&](size_t i) { return light_of(0.5f + 0.5f * gbuffer.normal.rgb(i)); }},
        {"material", false, [&](size_t i) { return sheet_material_color(gbuffer.material_id.values[i]); }},
        {"roughness", false, [&](size_t i) { return light_of(fourth(gbuffer.normal, i)); }},
        {"metalness", false, [&](size_t i) { return light_of(fourth(gbuffer.base_color, i)); }},
        {"motion", false, [&](size_t i) {
             const float *motion = &gbuffer.motion.values[2 * i], scale = 0.5f / most_motion;
             return light_of({0.5f + scale * motion[0], 0.5f + scale * motion[1], 0.5f});
         }}};
    const unsigned step = (gbuffer.extent().x + most_sheet_width - 1) / most_sheet_width;
    const glm::uvec2 picture = (gbuffer.extent() + step - 1u) / step,
                     room = picture + glm::uvec2(sheet_gap, sheet_gap + sheet_label_height);
    const unsigned rows = (unsigned(pictures.size()) + sheet_columns - 1) / sheet_columns;
    HostImage sheet({sheet_columns * room.x - sheet_gap, rows * room.y - sheet_gap}, 3, 1.0f);
    for (unsigned n = 0; n < pictures.size(); ++n) {
        const glm::uvec2 corner = glm::uvec2(n % sheet_columns, n / sheet_columns) * room;
        write_sheet_label(sheet, corner + 2u, pictures[n].label, corner.x + picture.x);
        for (unsigned y = 0; y < picture.y; ++y)
            for (unsigned x = 0; x < picture.x; ++x) {
                const size_t i = size_t(y * step) * gbuffer.extent().x + x * step;
                const size_t to = size_t(corner.y + sheet_label_height + y) * sheet.extent.x + corner.x + x;
                sheet.set_rgb(to, pictures[n].is_light || is_hit(i) ? pictures[n].color(i) : glm::vec3(0));
            }
    }
    return sheet;
}
