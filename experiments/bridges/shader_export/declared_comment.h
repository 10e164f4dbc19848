#pragma once
#include <string>

/// What a comment in C++ or GLSL says of the first variable, member or block of that name: the rest of its line, with
/// the comment lines that continue it, else the comment lines right above it. "" if there is none.
std::string declared_comment(const std::string& source, const std::string& name);
