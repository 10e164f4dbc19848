#pragma once
#include <string>

/// A file name, or a part of one, that says `text`: letters, digits, '.', '_' and '-' stay, the rest becomes '-'. One
/// longer than `longest` bytes is cut and ends in a hash of all of it, so that different texts stay different.
std::string file_name(const std::string& text, size_t longest = 100);
