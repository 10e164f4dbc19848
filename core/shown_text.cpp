#include "core/shown_text.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace {

struct Letter {
    char32_t code = 0;
    size_t bytes = 0;  ///< 0: no UTF-8 begins here
};

/// The first letter of a text that is not empty (Unicode 15, table 3-7: no overlong forms, no surrogates).
Letter first_letter(std::string_view text) {
    const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned first = byte(0);
    if (first < 0x80) return {first, 1};
    const size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4) return {};
    char32_t code = first & (0xFFu >> (bytes + 1));
    for (size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return {};
        code = code << 6 | (byte(i) & 0x3F);
    }
    const bool is_overlong = code < (bytes == 3 ? 0x800u : bytes == 4 ? 0x10000u : 0x80u);
    if (is_overlong || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return {};
    return {code, bytes};
}

bool is_obeyed(char32_t code) {
    constexpr std::array<std::pair<char32_t, char32_t>, 6> ranges = {
        {{0x00, 0x1F}, {0x7F, 0x9F}, {0x61C, 0x61C}, {0x200E, 0x200F}, {0x2028, 0x202E}, {0x2066, 0x2069}}};
    return std::ranges::any_of(ranges, [&](const auto& r) { return code >= r.first && code <= r.second; });
}

std::string escaped(const char* format, unsigned code) {
    char text[16];
    std::snprintf(text, sizeof text, format, code);
    return text;
}

}  // namespace

std::string shown_text(std::string_view text) {
    std::string shown;
    while (!text.empty()) {
        const Letter letter = first_letter(text);
        const size_t bytes = std::max<size_t>(letter.bytes, 1);
        if (letter.bytes == 0)
            shown += escaped("\\x%02x", static_cast<unsigned char>(text.front()));
        else if (!is_obeyed(letter.code))
            shown += text.substr(0, bytes);
        else if (const size_t named = std::u32string_view(U"\n\r\t").find(letter.code); named != std::string::npos)
            shown += std::string("\\") + "nrt"[named];
        else
            shown += escaped(letter.code < 0x80 ? "\\x%02x" : "\\u%04x", letter.code);
        text.remove_prefix(bytes);
    }
    return shown;
}

std::string shown_lines(std::string_view text) {
    std::string shown;
    for (size_t end = text.find('\n'); end != text.npos; end = text.find('\n')) {
        shown += shown_text(text.substr(0, end)) + "\n";
        text.remove_prefix(end + 1);
    }
    return shown + shown_text(text);
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const size_t bytes = first_letter(text).bytes;
        if (bytes == 0) return false;
        text.remove_prefix(bytes);
    }
    return true;
}
