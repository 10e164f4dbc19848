#pragma once
#include <charconv>
#include <concepts>
#include <string>

/// The number as operator<< writes it, with enough digits to distinguish it from its neighbours: "1e+06", "1.57079637".
std::string message_digits(std::floating_point auto value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof(text), value, std::chars_format::general).ptr};
}

/// The shortest decimal that reads back as `value`, an integer or a floating-point number: "0.05" for 0.05f.
std::string shortest_digits(auto value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}
