#include "experiments/bridges/shader_export/declared_comment.h"

#include <regex>
#include <sstream>
#include <vector>

namespace {

/// A line as its code and its comment; `is_noted`: it has a comment.
struct Line {
    std::string code, comment;
    bool is_noted = false;

    bool is_comment() const { return is_noted && code.find_first_not_of(" \t") == std::string::npos; }
};

Line line_of(const std::string& text) {
    const size_t at = text.find("//");
    if (at == std::string::npos) return {.code = text, .comment = {}};
    const size_t begin = text.find_first_not_of("/< ", at);
    return {text.substr(0, at), begin == std::string::npos ? "" : text.substr(begin), true};
}

void add(std::string& text, const std::string& more) { text += (text.empty() || more.empty() ? "" : " ") + more; }

}  // namespace

std::string declared_comment(const std::string& source, const std::string& name) {
    std::vector<Line> lines;
    std::istringstream in(source);
    for (std::string text; std::getline(in, text);) lines.push_back(line_of(text));
    const std::regex declaration(
        R"(^\s*((layout\s*\([^)]*\)|const|uniform|buffer|readonly|writeonly|coherent|restrict)\s+)*([A-Za-z]\w*\s+)?([\w, ]*[ ,])?)" +
        name + R"((\[\w*\])*\s*(=[^;]*)?(,[^;=(]*)?[;{,].*$)");
    for (size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].code.find(name) == std::string::npos || !std::regex_match(lines[i].code, declaration)) continue;
        std::string comment = lines[i].comment;
        if (lines[i].is_noted)
            for (size_t next = i + 1; next < lines.size() && lines[next].is_comment(); ++next) {
                constexpr size_t least_column = 12;  // characters; a comment about what follows stands at the begin
                if (lines[next].code.size() < least_column) break;
                add(comment, lines[next].comment);
            }
        if (!comment.empty()) return comment;
        size_t above = i;
        while (above > 0 && lines[above - 1].is_comment()) --above;
        for (; above < i; ++above) add(comment, lines[above].comment);
        return comment;
    }
    return "";
}
