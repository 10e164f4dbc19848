#include "experiments/results/files/markdown.h"

#include "core/shown_text.h"

#include <algorithm>
#include <string_view>

namespace {

using Letters = std::string_view;

bool is_word_letter(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_punctuation(char c) { return c > ' ' && c < 127 && !is_word_letter(c); }

/// Emphasis between letters is none by '_', and a bracket is a link's only before what leads somewhere: such stay as
/// they are, to be legible.
bool is_markup(Letters text, size_t at) {
    const char before = at > 0 ? text[at - 1] : ' ', after = at + 1 < text.size() ? text[at + 1] : '\0';
    switch (text[at]) {
        case '_':
            return !is_word_letter(before) || !is_word_letter(after);
        case ']':
            return after == '(' || after == '[' || after == ':';
        case '[':
            return after == '^';
        case '\\':
            return after == '\0' || is_punctuation(after);
        default:
            return Letters("|`*~$").find(text[at]) != Letters::npos;
    }
}

/// Whether an HTML entity begins here, as &lt; or &#60;.
bool is_entity(Letters text) {
    size_t end = text.starts_with("&#") ? 2 : 1;
    const size_t begin = end;
    while (end < text.size() &&
           (is_word_letter(text[end]) || text[end] == '_' || static_cast<signed char>(text[end]) < 0))
        ++end;
    return end > begin && end < text.size() && text[end] == ';';
}

}  // namespace

std::string markdown_text(const std::string& text) {
    std::string shown = shown_text(text), escaped, plain;
    const size_t begin = std::min(shown.find_first_not_of(' '), shown.size());
    shown = shown.substr(begin, shown.find_last_not_of(' ') + 1 - begin);
    for (size_t i = 0; i < shown.size(); ++i) {
        if (is_markup(shown, i)) escaped += '\\';
        escaped += shown[i];
    }
    for (size_t i = 0; i < escaped.size(); ++i)
        plain += escaped[i] == '<'                                            ? "&lt;"
                 : escaped[i] == '&' && is_entity(Letters(escaped).substr(i)) ? "&amp;"
                                                                              : std::string(1, escaped[i]);
    return plain;
}

std::string markdown_code(const std::string& text) {
    const std::string shown = shown_text(text);
    size_t longest = 0, run = 0;
    for (const char c : shown) run = c == '`' ? run + 1 : 0, longest = std::max(longest, run);
    const std::string fence(longest + 1, '`');
    const bool is_blank = shown.find_first_not_of(' ') == std::string::npos;
    const std::string space = is_blank || shown.starts_with('`') || shown.ends_with('`') ? " " : "";
    return fence + space + shown + space + fence;
}

std::string markdown_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows) {
    std::string text, rule = "|";
    for (const std::string& cell : head) text += "| " + cell + " ", rule += "---|";
    text += "|\n" + rule + "\n";
    for (const std::vector<std::string>& row : rows) {
        for (const std::string& cell : row) text += "| " + markdown_text(cell) + " ";
        text += "|\n";
    }
    return text + "\n";
}
