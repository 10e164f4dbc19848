#pragma once
#include <functional>
#include <string>
#include <vector>

// Lists of names, also in sentences.

/// One name per element: a member of it, or the result of a function.
template <class Range, class Name = std::identity>
std::vector<std::string> names_of(const Range& all, Name name = {}) {
    std::vector<std::string> names;
    for (const auto& one : all) names.emplace_back(std::invoke(name, one));
    return names;
}

/// "A, B, C".
std::string joined(const std::vector<std::string>& names, const std::string& between = ", ");
/// "A, B and C"; beyond `most` "A, B and 7 more".
std::string listed(const std::vector<std::string>& names, size_t most = SIZE_MAX);
/// "1 cell", "2 cells".
std::string counted(size_t count, const std::string& what);
