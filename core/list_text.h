#pragma once
#include <string>
#include <vector>

// Lists of names in sentences.

/// "A, B, C".
std::string joined(const std::vector<std::string>& names, const std::string& between = ", ");
/// "A, B and C"; beyond `most` "A, B and 7 more".
std::string listed(const std::vector<std::string>& names, size_t most = SIZE_MAX);
/// "1 cell", "2 cells".
std::string counted(size_t count, const std::string& what);
