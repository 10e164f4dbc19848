#include "experiments/bridges/shader_export/screen_share.h"

#include "core/number_text.h"

std::string share_text(const SizeAtTwoScreens& s) {
    const auto text_of = [](glm::uvec2 size) { return std::to_string(size.x) + " x " + std::to_string(size.y); };
    if (s.size == s.size_at_double) return text_of(s.size);
    constexpr unsigned most = 256;  // pixels of a side of what one texel or workgroup stands for
    const glm::uvec2 twice = 2u * s.screen;
    for (unsigned divisor = 1; divisor <= most; ++divisor) {
        const std::string by = divisor == 1 ? "" : "/" + std::to_string(divisor);
        const std::string share = "W" + by + " x H" + by;
        const bool is_down = s.size == max(s.screen / divisor, 1u) && s.size_at_double == max(twice / divisor, 1u);
        const bool is_up =
            s.size == (s.screen + divisor - 1u) / divisor && s.size_at_double == (twice + divisor - 1u) / divisor;
        if (is_up && is_down) return share;
        if (is_up || is_down) return share + (is_up ? " rounded up" : " rounded down");
    }
    return "";
}

std::string bytes_text(glm::uvec2 screen, size_t bytes, size_t bytes_at_double) {
    if (bytes == bytes_at_double) return std::to_string(bytes);
    const double pixels = double(screen.x) * screen.y;
    const double share = double(bytes_at_double - bytes) / (3 * pixels), rest = double(bytes) - share * pixels;
    const std::string text = number_text(share) + " * W * H";
    return std::abs(rest) < 0.5 ? text : "about " + text;
}
