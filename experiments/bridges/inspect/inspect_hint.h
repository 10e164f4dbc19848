#pragma once
#include <string>

/// A hint for the message of an Error: "`ssrlab inspect a.exr` shows what ssrlab understands of the file". "" unless
/// the message names an existing image or glTF file.
std::string inspect_hint(const std::string& message);
