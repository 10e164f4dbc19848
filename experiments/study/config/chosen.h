#pragma once
#include "core/error.h"
#include "core/near_miss.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

/// The elements of `all` that `wanted` names, in the order of `all`; every element if `wanted` is empty.
/// `names_of(one)` returns the names that select an element. Fails with Error on a name that selects none, and suggests
/// the nearest name; `what` says in the message what is named ("metric").
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
