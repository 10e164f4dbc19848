#include "core/near_miss.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace {

/// Insertions, deletions, substitutions and exchanges of neighbours cost 1 each.
size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<size_t>> cost(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
    for (size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
    for (size_t i = 1; i <= a.size(); ++i)
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t substitution = cost[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, substitution});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    return cost[a.size()][b.size()];
}

/// The text without what data URIs hold: the letters behind ";base64," up to a quote, a blank or the end.
std::string without_data(const std::string& text) {
    constexpr std::string_view mark = ";base64,";
    const auto equals = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
    std::string shown;
    for (auto at = text.begin();;) {
        const auto found = std::search(at, text.end(), mark.begin(), mark.end(), equals);
        if (found == text.end()) return shown.append(at, text.end());
        const auto data = found + long(mark.size());
        shown.append(at, data).append("...");
        at = std::find_if(data, text.end(), [](char c) {
            return !std::isalnum(static_cast<unsigned char>(c)) &&
                   std::string_view("+/=%-_").find(c) == std::string_view::npos;
        });
    }
}

constexpr size_t longest_name = 100;  ///< bytes: the distance takes time and memory of the product of both lengths

constexpr size_t most_listed = 30, nearest_listed = 5;  ///< more names are no answer, but a page

/// The first ones in order of their distance.
std::vector<std::string> nearest_names(std::string_view name, std::span<const std::string> choices) {
    std::vector<std::pair<size_t, std::string>> by_distance;
    for (const std::string& choice : choices) {
        const bool is_long = std::max(name.size(), choice.size()) > longest_name;
        by_distance.emplace_back(is_long ? SIZE_MAX : edit_distance(name, choice), shortened(choice));
    }
    std::ranges::sort(by_distance);
    by_distance.resize(std::min(by_distance.size(), nearest_listed));
    return names_of(by_distance, &std::pair<size_t, std::string>::second);
}

}  // namespace

std::string shortened(const std::string& whole) {
    constexpr size_t longest = 300, end = 80;
    const std::string text = without_data(whole);
    if (text.size() <= longest) return text;
    const auto begins_character = [&](size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80; };
    size_t head = longest - end, tail = text.size() - end;
    while (head > 0 && !begins_character(head)) --head;  // no UTF-8 sequence is cut
    while (tail < text.size() && !begins_character(tail)) ++tail;
    return text.substr(0, head) + " ... " + text.substr(tail);
}

std::string nearest_name(std::string_view name, std::span<const std::string> choices) {
    std::string best;
    if (name.size() > longest_name) return best;
    size_t best_distance = std::max<size_t>(1, name.size() / 3) + 1;
    for (const std::string& choice : choices) {
        if (choice.size() > longest_name) continue;
        if (const size_t distance = edit_distance(name, choice); distance < best_distance) {
            best_distance = distance;
            best = choice;
        }
    }
    if (!best.empty()) return best;
    constexpr size_t distinctive = 5;  // letters: shorter names are part of many others
    for (const std::string& choice : choices)
        if (name.size() >= distinctive && choice.size() <= longest_name && choice.find(name) != std::string::npos)
            return choice;
    return best;
}

std::string suggestion(std::string_view name, std::span<const std::string> choices, const std::string& command) {
    if (const std::string near = nearest_name(name, choices); !near.empty()) return "; did you mean '" + near + "'?";
    if (choices.empty()) return "; there are none";
    if (choices.size() <= most_listed) return "; known are: " + joined(names_of(choices, shortened));
    return "; the nearest of " + std::to_string(choices.size()) +
           " names are: " + joined(nearest_names(name, choices)) +
           (command.empty() ? "" : "; `" + command + "` lists all");
}
