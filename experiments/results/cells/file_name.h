#pragma once
#include <string>

/// Makes a file name, or a part of one, from `text`: letters, digits, '.', '_' and '-' stay, all else becomes '-'. A
/// name longer than `longest` bytes is cut and ends in a hash of the whole, so that different texts stay different.
std::string file_name(const std::string& text, size_t longest = 100);
