#pragma once
#include <cstdio>
#include <optional>
#include <string>

// What the terminal shows that a stream goes to.

/// Columns of its lines, at least 20: the variable COLUMNS, or else what the terminal says. None of a pipe or a file,
/// where COLUMNS is not set.
std::optional<size_t> terminal_columns(std::FILE* stream);

/// Whether texts may have colours: on a terminal that is not "dumb", unless NO_COLOR is set (https://no-color.org).
bool has_colors(std::FILE* stream);

/// The text as a heading, bold where the stream has colours.
std::string heading(const std::string& text, std::FILE* stream = stdout);

/// Prints "error: TEXT" to stderr, its first word red where stderr has colours. What is in `text` must be harmless to a
/// terminal: shown_text().
void say_error(const std::string& text);
