#pragma once
#include <string>

/// "`ssrlab inspect a.exr` shows what ssrlab understands of the file", for the message of an Error that names an image
/// or glTF file that is there; "" for any other.
std::string inspect_hint(const std::string& message);
