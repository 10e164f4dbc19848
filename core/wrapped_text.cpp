#include "core/wrapped_text.h"

#include <algorithm>
#include <sstream>

namespace {

constexpr size_t readable = 30;  ///< columns: narrower texts break in the middle of phrases

std::string blanks(size_t count) { return std::string(count, ' '); }

}  // namespace

size_t letters_of(std::string_view text) {
    return size_t(std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string wrapped(const std::string& text, size_t indent, std::optional<size_t> columns) {
    std::istringstream words(text);
    std::string lines, line;
    for (std::string word; words >> word;) {
        if (columns && !line.empty() && indent + letters_of(line) + 1 + letters_of(word) > *columns) {
            lines += blanks(indent) + line + '\n';
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    return lines + blanks(indent) + line + '\n';
}

std::string fitted(const std::string& lines, std::optional<size_t> columns) {
    constexpr size_t hanging = 4;
    if (!columns) return lines;
    std::istringstream text(lines);
    std::string all;
    for (std::string line; std::getline(text, line);) {
        if (letters_of(line) <= *columns) {
            all += line + '\n';
            continue;
        }
        size_t indent = std::min(line.find_first_not_of(' '), line.size());
        if (indent + readable > *columns) indent = std::min(indent, hanging);
        const std::string first = wrapped(line, indent, columns), begin = first.substr(0, first.find('\n') + 1);
        const std::string rest = first.substr(begin.size());
        all += begin + (rest.empty() ? "" : wrapped(rest, indent + hanging, columns));
    }
    return all;
}

std::string cut_to(const std::string& text, size_t columns) {
    if (letters_of(text) <= columns) return text;
    size_t end = 0;
    for (size_t letters = 0; end < text.size(); ++end)
        if ((static_cast<unsigned char>(text[end]) & 0xC0) != 0x80 && ++letters > columns - 3) break;
    return text.substr(0, end) + "...";
}

std::string beside(const std::string& name, const std::string& text, size_t indent, std::optional<size_t> columns) {
    const size_t name_indent = std::min(name.find_first_not_of(' '), name.size());
    if (columns && indent + readable > *columns)
        return wrapped(name, name_indent, columns) + (text.empty() ? "" : wrapped(text, name_indent + 4, columns));
    if (text.empty()) return name + '\n';
    const std::string lines = wrapped(text, indent, columns);
    if (letters_of(name) + 1 > indent) return wrapped(name, name_indent, columns) + lines;
    return name + lines.substr(letters_of(name));
}
