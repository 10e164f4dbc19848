#include "core/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

namespace {

constexpr size_t least_columns = 20;

std::string_view variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

// ECMA-48, 8.3.117 (SGR).
constexpr const char *bold = "\x1b[1m", *bold_red = "\x1b[1;31m", *plain = "\x1b[0m";

}  // namespace

std::optional<size_t> terminal_columns(std::FILE* stream) {
    const std::string_view asked = variable("COLUMNS");
    unsigned short columns = 0;
    std::from_chars(asked.data(), asked.data() + asked.size(), columns);
    winsize window{};
    if (columns == 0 && ioctl(fileno(stream), TIOCGWINSZ, &window) == 0) columns = window.ws_col;
    if (columns == 0) return {};
    return std::max<size_t>(columns, least_columns);
}

bool has_colors(std::FILE* stream) {
    return isatty(fileno(stream)) && variable("NO_COLOR").empty() && variable("TERM") != "dumb";
}

std::string heading(const std::string& text, std::FILE* stream) {
    return has_colors(stream) ? bold + text + plain : text;
}

void say_error(const std::string& text) {
    const bool is_red = has_colors(stderr);
    std::fprintf(stderr, "%serror:%s %s\n", is_red ? bold_red : "", is_red ? plain : "", text.c_str());
}
