#pragma once
#include "core/error.h"
#include "core/list_text.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>

/// The text as messages show it: the middle of a long one is left out, and so are the data of data URIs.
std::string shortened(const std::string& text);

/// The member of `choices` nearest to `name` by Damerau-Levenshtein distance (optimal string alignment), if that is
/// within a third of its length. Else the first choice that contains `name` ("thickness": "relative_thickness"), or "".
/// A text of more than 100 characters is no misspelt name and near none.
std::string nearest_name(std::string_view name, std::span<const std::string> choices);

/// "; did you mean 'thickness'?" of a near miss, else "; known are: a, b, c", or "; there are none". Of more than 30
/// choices the nearest are named, and the command that lists all, if it is given.
std::string suggestion(std::string_view name, std::span<const std::string> choices, const std::string& command = "");

/// The command that lists all names, for suggestion().
struct ListedBy {
    std::string command;
};

/// The entry with that `name`; fails with "<what> 'NAME'; did you mean ..." if there is none.
template <std::ranges::borrowed_range Entries, class... What>
auto& find_named(Entries&& entries, const std::string& name, const ListedBy& by, const What&... what) {
    const auto name_of = [](const auto& entry) -> const std::string& { return entry.name; };
    const auto found = std::ranges::find(entries, name, name_of);
    if (found == std::ranges::end(entries))
        fail(what..., " '", shortened(name), "'", suggestion(name, names_of(entries, name_of), by.command));
    return *found;
}
template <std::ranges::borrowed_range Entries, class... What>
auto& find_named(Entries&& entries, const std::string& name, const What&... what) {
    return find_named(std::forward<Entries>(entries), name, ListedBy{}, what...);
}
