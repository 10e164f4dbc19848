#pragma once
#include "core/error.h"
#include "core/near_miss.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

/// Those of `all` that `wanted` names, in the order of `all`; all of them if it names none. `names_of(one)`: the names
/// that one answers to. Fails with Error, with a near miss, on a name that none answers to; `what` says there what it
/// should be the name of.
template <class T, class NamesOf>
std::vector<T> chosen(const std::vector<T>& all, const std::vector<std::string>& wanted, const char* what,
                      const NamesOf& names_of) {
    if (wanted.empty()) return all;
    std::vector<std::string> known;
    std::vector<T> result;
    for (const T& one : all) {
        const std::vector<std::string> names = names_of(one);
        for (const std::string& name : names)
            if (!std::ranges::count(known, name)) known.push_back(name);
        if (std::ranges::find_first_of(names, wanted) != names.end()) result.push_back(one);
    }
    for (const std::string& name : wanted)
        if (!std::ranges::count(known, name)) fail("unknown ", what, " '", name, "'", suggestion(name, known));
    return result;
}
