#pragma once
#include <string>
#include <string_view>

/// A text that may come from a stranger's file, in one line that is harmless to a terminal. Control characters, marks
/// that turn the direction of writing and bytes that are no UTF-8 become \n, \x1b, \u202e, \xff. Commands print all
/// names by it; scripts have shown() of experiments/python/ssrlab/mistakes.py.
std::string shown_text(std::string_view text);

/// The same of a text of several lines, which stay lines. Its names must be shown_text() already, or they forge lines.
std::string shown_lines(std::string_view text);

/// Whether JSON can hold the text.
bool is_utf8(std::string_view text);
