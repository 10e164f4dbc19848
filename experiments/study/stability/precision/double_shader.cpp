#include "experiments/study/stability/precision/double_shader.h"

#include "core/gpu/pipelines/shader_files.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

namespace {

enum class Kind { word, number, directive, space, sign };

struct Token {
    Kind kind;
    std::string text;
};
using Tokens = std::vector<Token>;

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// The end of the token that begins at `at`.
size_t end_of(const std::string& text, size_t at, Kind& kind) {
    const auto skip = [&](auto&& belongs) {
        size_t end = at;
        while (end < text.size() && belongs(end)) ++end;
        return end;
    };
    const char c = text[at], next = at + 1 < text.size() ? text[at + 1] : '\0';
    kind = Kind::space;
    if (std::isspace(static_cast<unsigned char>(c)))
        return skip([&](size_t i) { return std::isspace(static_cast<unsigned char>(text[i])) != 0; });
    if (c == '/' && next == '/') return std::min(text.find('\n', at), text.size());
    if (c == '/' && next == '*') return std::min(text.find("*/", at + 2), text.size() - 2) + 2;
    kind = Kind::directive;
    if (c == '#')  // to the end of the line, which a backslash carries on
        return skip([&](size_t i) { return text[i] != '\n' || text[i - 1] == '\\'; });
    kind = Kind::number;
    if (std::isdigit(static_cast<unsigned char>(c)) || (c == '.' && std::isdigit(static_cast<unsigned char>(next))))
        return skip([&](size_t i) {
            const bool is_sign_of_exponent =
                (text[i] == '+' || text[i] == '-') && (text[i - 1] == 'e' || text[i - 1] == 'E');
            return is_word(text[i]) || text[i] == '.' || is_sign_of_exponent;
        });
    kind = Kind::word;
    if (is_word(c)) return skip([&](size_t i) { return is_word(text[i]); });
    kind = Kind::sign;
    return at + 1;
}

Tokens tokens_of(const std::string& text) {
    Tokens tokens;
    for (size_t at = 0; at < text.size();) {
        Kind kind{};
        const size_t end = end_of(text, at, kind);
        tokens.push_back({kind, text.substr(at, end - at)});
        at = end;
    }
    return tokens;
}

std::string text_of(const Tokens& tokens) {
    std::string text;
    for (const Token& token : tokens) text += token.text;
    return text;
}

bool is_of_floats(const std::string& type) {
    return type == "float" || type.starts_with("vec") || (type.starts_with("mat") && type.size() < 7);
}

std::string wide_type(const std::string& type) {
    if (type == "float") return "double";
    return is_of_floats(type) && type.size() > 3 && std::isdigit(static_cast<unsigned char>(type[3])) ? "d" + type
                                                                                                      : type;
}

std::string wide_literal(const std::string& number) {
    if (number.starts_with("0x") || number.starts_with("0X")) return number;
    const bool has_suffix = number.ends_with('f') || number.ends_with('F');
    if (number.find_first_of(".eE") == std::string::npos && !has_suffix) return number;
    return number.substr(0, number.size() - has_suffix) + "LF";
}

/// Everything between two functions, or one of them.
struct Statement {
    Tokens tokens;
    std::vector<size_t> words;  ///< tokens that are neither space nor directives

    const std::string& word(size_t i) const {
        static const std::string none;
        return i < words.size() ? tokens[words[i]].text : none;
    }
    bool is_struct() const { return word(0) == "struct"; }
    /// Shares memory with what is outside of the shader, so that its layout must stay.
    bool is_interface() const {
        if (word(0) == "layout") return true;
        for (size_t i = 0; i < words.size(); ++i) {
            const std::string& w = word(i);
            if (w == "(" || w == "{" || w == "=" || w == "struct") return false;
            if (w == "uniform" || w == "buffer" || w == "in" || w == "out") return true;
        }
        return false;
    }
};

std::vector<Statement> statements_of(const Tokens& tokens) {
    std::vector<Statement> statements(1);
    int braces = 0, parentheses = 0;
    for (const Token& token : tokens) {
        Statement& statement = statements.back();
        if (token.kind != Kind::space && token.kind != Kind::directive)
            statement.words.push_back(statement.tokens.size());
        statement.tokens.push_back(token);
        if (token.text == "{") ++braces;
        if (token.text == "(") ++parentheses;
        if (token.text == ")") --parentheses;
        const bool closes = token.text == "}" && --braces == 0;
        const bool ends_function = closes && !statement.is_struct() && !statement.is_interface();
        if (ends_function || (token.text == ";" && braces == 0 && parentheses == 0)) statements.emplace_back();
    }
    return statements;
}

struct Member {
    std::string type, name;
};

/// Of a struct or a block: "type name, name[];" between its braces.
std::vector<Member> members_of(const Statement& statement) {
    std::vector<Member> members;
    bool is_inside = false;
    std::string type;
    for (size_t i = 0; i < statement.words.size(); ++i) {
        const std::string& w = statement.word(i);
        if (w == "{")
            is_inside = true, type.clear();
        else if (w == "}")
            is_inside = false;
        else if (!is_inside)
            continue;
        else if (w == ";")
            type.clear();
        else if (type.empty())
            type = w;
        else if (const std::string& next = statement.word(i + 1); next == ";" || next == "," || next == "[")
            if (is_word(w[0]) && statement.word(i - 1) != "[") members.push_back({type, w});
    }
    return members;
}

class Converter {
public:
    explicit Converter(const Tokens& tokens) : statements_(statements_of(tokens)) {
        std::set<std::string> structs;
        for (const Statement& s : statements_) {
            if (s.is_struct()) structs.insert(s.word(1));
            if (!s.is_interface()) continue;
            for (const Member& m : members_of(s)) {
                if (std::ranges::count_if(s.words, [&](size_t w) { return s.tokens[w].text == "buffer"; }) &&
                    is_of_floats(m.type))
                    stored_[m.name] = m.type;
                if (structs.contains(m.type)) kept_structs_.insert(m.type);
            }
            const auto out = std::ranges::find_if(s.words, [&](size_t w) { return s.tokens[w].text == "out"; });
            if (out != s.words.end()) {
                const size_t at = size_t(out - s.words.begin());
                if (is_of_floats(s.word(at + 1))) outputs_.push_back({s.word(at + 1), s.word(at + 2)});
            }
        }
        const std::string depth = "gl_FragDepth";
        if (std::ranges::find(tokens, depth, &Token::text) != tokens.end()) outputs_.push_back({"float", depth});
    }

    std::string text() const {
        std::string text;
        for (const Member& output : outputs_) text += wide_type(output.type) + " " + inner(output.name) + ";\n";
        text += "#line 1 0\n";
        for (const Statement& s : statements_) {
            const bool is_kept = s.is_struct() && kept_structs_.contains(s.word(1));
            text += s.is_interface() || is_kept ? text_of(s.tokens) : converted(s.tokens, !s.is_struct());
            if (is_kept) text += constructor_of(s);
        }
        text += "\nvoid main() {\n    " + inner("main") + "();\n";
        for (const Member& output : outputs_)
            text += "    " + output.name + " = " + output.type + "(" + inner(output.name) + ");\n";
        return text + "}\n";
    }

private:
    static std::string inner(const std::string& name) { return "wide_" + name; }

    /// A struct that keeps its floats is made of doubles: wide_type(double, ...).
    static std::string constructor_of(const Statement& s) {
        std::string parameters, arguments;
        for (const Member& m : members_of(s)) {
            const std::string between = parameters.empty() ? "" : ", ";
            parameters += between + wide_type(m.type) + " " + m.name;
            arguments += between + (is_of_floats(m.type) ? m.type + "(" + m.name + ")" : m.name);
        }
        const std::string& type = s.word(1);
        return " " + type + " " + inner(type) + "(" + parameters + ") { return " + type + "(" + arguments + "); }";
    }

    std::string converted(const Tokens& tokens, bool renames) const {
        std::map<size_t, std::string> before;  // what comes in front of a token
        std::string text, last;
        for (size_t i = 0; i < tokens.size(); ++i) {
            const Token& token = tokens[i];
            text += before[i];
            if (token.kind == Kind::directive)
                text += token.text.starts_with("#define")
                            ? "#define" + converted(tokens_of(token.text.substr(7)), renames)
                            : token.text;
            else if (token.kind == Kind::number)
                text += wide_literal(token.text);
            else if (token.kind == Kind::word && kept_structs_.contains(token.text) && next_of(tokens, i) == "(")
                text += inner(token.text);
            else if (token.kind == Kind::word)
                text += word(token.text, renames && last != ".");
            else
                text += token.text;
            if (token.kind == Kind::word && stored_.contains(token.text)) round_store(tokens, i, before);
            if (token.kind != Kind::space) last = token.text;
        }
        return text;
    }

    std::string word(const std::string& word, bool renames) const {
        const bool is_output = std::ranges::any_of(outputs_, [&](const Member& m) { return m.name == word; });
        if (renames && (is_output || word == "main")) return inner(word);
        return wide_type(word);
    }

    static size_t after(const Tokens& tokens, size_t i) {
        do ++i;
        while (i < tokens.size() && tokens[i].kind == Kind::space);
        return i;
    }
    static std::string next_of(const Tokens& tokens, size_t i) {
        const size_t next = after(tokens, i);
        return next < tokens.size() ? tokens[next].text : "";
    }

    /// `name[...] = value;` becomes `name[...] = type(value);`.
    void round_store(const Tokens& tokens, size_t name, std::map<size_t, std::string>& before) const {
        size_t i = after(tokens, name);
        if (i >= tokens.size() || tokens[i].text != "[") return;
        for (int depth = 0; i < tokens.size(); ++i) {
            depth += tokens[i].text == "[" ? 1 : tokens[i].text == "]" ? -1 : 0;
            if (depth == 0) break;
        }
        i = after(tokens, i);
        if (i + 1 >= tokens.size() || tokens[i].text != "=" || tokens[i + 1].text == "=") return;
        before[i + 1] = " " + stored_.at(tokens[name].text) + "(";
        while (i < tokens.size() && tokens[i].text != ";") ++i;
        before[i] = ")";
    }

    std::vector<Statement> statements_;
    std::set<std::string> kept_structs_;
    std::map<std::string, std::string> stored_;  ///< types of float members of buffers
    std::vector<Member> outputs_;                ///< of a fragment shader
};

}  // namespace

std::string in_double(const std::string& glsl, const std::string& functions) {
    return functions + Converter(tokens_of(glsl)).text();
}

std::function<std::optional<GlslChange>(const std::string& stage)> double_where(
    std::function<bool(const std::string& stage)> is_double) {
    return [is_double = std::move(is_double)](const std::string& stage) -> std::optional<GlslChange> {
        if (!is_double(stage)) return {};
        return GlslChange{
            "in double", [](const std::string& glsl) {
                return in_double(glsl, read_shader("experiments/study/stability/precision/double_functions.glsl").text);
            }};
    };
}
