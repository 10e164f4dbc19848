#pragma once
#include <optional>
#include <string>
#include <string_view>

/// Letters of a UTF-8 text, which a terminal shows in one column each (of wide letters it takes two).
size_t letters_of(std::string_view text);

/// The words of `text` in lines of at most `columns`, each line behind `indent` blanks and with a line feed. A longer
/// word stands alone. Without `columns` all is one line.
std::string wrapped(const std::string& text, size_t indent, std::optional<size_t> columns);

/// The lines of a text, those longer than `columns` wrapped: what follows begins four columns right of the line's first
/// letter. Where that leaves too few columns for a text, a line begins further left.
std::string fitted(const std::string& lines, std::optional<size_t> columns);

/// The text, or its beginning and "..." where it has more letters than `columns`, which are at least 3.
std::string cut_to(const std::string& text, size_t columns);

/// `name`, and `text` beside it from column `indent` on, wrapped. Where that leaves too few columns for a text, or the
/// name reaches into them, the text begins on the next line.
std::string beside(const std::string& name, const std::string& text, size_t indent, std::optional<size_t> columns);
