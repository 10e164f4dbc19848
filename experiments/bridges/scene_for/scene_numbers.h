#pragma once
#include "core/digits.h"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>

/// A float as JSON with the fewest digits that identify it: 0.1, where the double of the same value is
/// 0.10000000149011612.
inline nlohmann::json number_of(float value) { return std::stod(shortest_digits(value)); }

template <class Vector>
void append_numbers(nlohmann::json& to, const Vector& vector) {
    for (int i = 0; i < Vector::length(); ++i) to.push_back(number_of(vector[i]));
}

template <class Vector>
nlohmann::json numbers_of(const Vector& vector) {
    nlohmann::json numbers = nlohmann::json::array();
    append_numbers(numbers, vector);
    return numbers;
}

/// The sixteen numbers of a matrix, column by column.
inline nlohmann::json matrix_numbers(const glm::mat4& matrix) {
    nlohmann::json numbers = nlohmann::json::array();
    for (int column = 0; column < 4; ++column) append_numbers(numbers, matrix[column]);
    return numbers;
}
