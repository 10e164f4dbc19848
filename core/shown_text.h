#pragma once
#include <string>
#include <string_view>

/// A text that may come from somebody else's file, in one line that a terminal only shows: control characters, marks
/// that turn the direction of writing and bytes that are no UTF-8 become \n, \x1b, \u202e, \xff. All that commands
/// print of names goes through it; scripts have the same (shown() of experiments/python/ssrlab/mistakes.py).
std::string shown_text(std::string_view text);
