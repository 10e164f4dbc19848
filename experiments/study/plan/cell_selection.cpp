#include "experiments/study/plan/cell_selection.h"

#include "core/error.h"
#include "core/near_miss.h"

#include <algorithm>
#include <charconv>

namespace {

/// Whether `text` is `pattern`, in which * stands for any text.
bool matches(std::string_view pattern, std::string_view text) {
    const size_t star = pattern.find('*');
    if (star == std::string_view::npos) return pattern == text;
    if (!text.starts_with(pattern.substr(0, star))) return false;
    for (size_t from = star; from <= text.size(); ++from)
        if (matches(pattern.substr(star + 1), text.substr(from))) return true;
    return false;
}

struct Shard {
    unsigned index = 0, count = 0;
};

Shard read_shard(const std::string& text) {
    Shard shard;
    const char* const end = text.data() + text.size();
    const auto index = std::from_chars(text.data(), end, shard.index);
    const bool has_slash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
    const auto count = has_slash ? std::from_chars(index.ptr + 1, end, shard.count) : index;
    if (!has_slash || count.ec != std::errc() || count.ptr != end || shard.index < 1 || shard.index > shard.count)
        fail("--cells: 'shard=", text, "' must be shard=I/N with I from 1 to N");
    return shard;
}

/// A number that is spread evenly: cells' names are hashes in hexadecimal digits.
unsigned long number_of(const std::string& name) { return std::stoul(name.substr(0, 12), nullptr, 16); }

}  // namespace

CellSelection::CellSelection(const std::vector<std::string>& terms) {
    const auto add = [&](const std::string& kind, Test test) {
        auto found = std::ranges::find(tests_, kind, [](const auto& tests) { return tests.first; });
        if (found == tests_.end()) found = tests_.insert(tests_.end(), {kind, {}});
        found->second.push_back(std::move(test));
    };
    for (const std::string& term : terms) {
        if (const auto kind = std::ranges::find(cell_kind_names(), term); kind != cell_kind_names().end()) {
            add("kind",
                [of = CellKind(kind - cell_kind_names().begin())](const PlannedCell& c) { return c.kind == of; });
            continue;
        }
        const size_t equals = term.find('=');
        const std::string key = term.substr(0, equals),
                          value = equals == std::string::npos ? "" : term.substr(equals + 1);
        if (key == "shot")
            add(key, [value](const PlannedCell& c) { return matches(value, c.shot); });
        else if (key == "technique")
            add(key, [value](const PlannedCell& c) { return c.technique && matches(value, c.technique->technique); });
        else if (key == "cell" && !value.empty())
            add(key, [value](const PlannedCell& c) { return c.name.starts_with(value); });
        else if (key == "shard")
            add(key, [shard = read_shard(value)](const PlannedCell& c) {
                return number_of(c.name) % shard.count == shard.index - 1;
            });
        else {
            std::vector<std::string> known = cell_kind_names();
            known.insert(known.end(), {"shot=NAME", "technique=NAME", "shard=I/N", "cell=HASH"});
            fail("--cells: '", term, "' is not a selection of cells", suggestion(term, known));
        }
    }
}

bool CellSelection::is_shard() const {
    return std::ranges::any_of(tests_, [](const auto& tests) { return tests.first == "shard"; });
}

bool CellSelection::holds(const PlannedCell& cell) const {
    return std::ranges::all_of(tests_, [&](const auto& tests) {
        return std::ranges::any_of(tests.second, [&](const Test& test) { return test(cell); });
    });
}
