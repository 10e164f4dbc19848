#include "experiments/bridges/shader_export/screen_share.h"

#include "core/number_text.h"

#include <vector>

namespace {

/// Pixels of a side for which one texel, workgroup or element of a buffer may stand; powers of two are likelier.
std::vector<unsigned> divisors() {
    std::vector<unsigned> all;
    for (unsigned power = 1; power <= 256; power *= 2) all.push_back(power);
    for (unsigned other = 3; other <= 256; ++other) all.push_back(other);
    return all;
}

glm::uvec2 rounded_down(glm::uvec2 screen, unsigned divisor) { return max(screen / divisor, 1u); }
glm::uvec2 rounded_up(glm::uvec2 screen, unsigned divisor) { return (screen + divisor - 1u) / divisor; }

}  // namespace

std::string share_text(const SizeOnTwoScreens<glm::uvec2>& s) {
    if (s.size == s.other_size) return std::to_string(s.size.x) + " x " + std::to_string(s.size.y);
    for (const unsigned divisor : divisors()) {
        const std::string by = divisor == 1 ? "" : "/" + std::to_string(divisor);
        const auto is_share = [&](const auto& rounded) {
            return s.size == rounded(s.screen, divisor) && s.other_size == rounded(s.other_screen, divisor);
        };
        const bool is_up = is_share(rounded_up), is_down = is_share(rounded_down);
        const char* const rounding = is_up && is_down ? "" : is_up ? " rounded up" : " rounded down";
        if (is_up || is_down) return "W" + by + " x H" + by + rounding;
    }
    return "";
}

std::string bytes_text(const SizeOnTwoScreens<size_t>& s) {
    if (s.size == s.other_size) return std::to_string(s.size);
    const auto area = [](glm::uvec2 size) { return size_t(size.x) * size.y; };
    for (const unsigned divisor : divisors()) {
        const size_t elements = area(rounded_up(s.screen, divisor)), others = area(rounded_up(s.other_screen, divisor)),
                     each = s.size / elements;
        if (each == 0 || s.size != each * elements || s.other_size != each * others) continue;
        const std::string by = std::to_string(divisor);
        return std::to_string(each) + (divisor == 1 ? " * W * H" : " * ceil(W/" + by + ") * ceil(H/" + by + ")");
    }
    return "about " + number_text(double(s.other_size) / double(area(s.other_screen))) + " * W * H";
}
