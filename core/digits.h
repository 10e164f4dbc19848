#pragma once
#include <charconv>
#include <string>

/// The shortest decimal that reads back as `value`, an integer or a floating-point number: "0.05" for 0.05f.
std::string shortest_digits(auto value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}
