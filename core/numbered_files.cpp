#include "core/numbered_files.h"

#include "core/error.h"

#include <algorithm>
#include <map>

namespace fs = std::filesystem;

namespace {

/// Where the last run of # stands.
struct Run {
    size_t first, end;
};

std::optional<Run> last_run(const std::string& text, size_t from) {
    const size_t last = text.find_last_of('#');
    if (last == std::string::npos || last < from) return std::nullopt;
    const size_t before = text.find_last_not_of('#', last);
    return Run{before == std::string::npos ? 0 : before + 1, last + 1};
}

/// The number in `name` where the pattern has its run; nullopt if the name is another one.
std::optional<unsigned> number_in(const std::string& name, const std::string& pattern, const Run& run) {
    const std::string start = pattern.substr(0, run.first), end = pattern.substr(run.end);
    const size_t least = run.end - run.first, around = start.size() + end.size();
    if (!name.starts_with(start) || !name.ends_with(end) || name.size() < around + least) return std::nullopt;
    const std::string digits = name.substr(start.size(), name.size() - around);
    const bool has_padding = digits.size() > least && digits[0] == '0';  // a longer number has no zeros before it
    if (digits.size() > 9 || has_padding || !std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; }))
        return std::nullopt;
    return unsigned(std::stoul(digits));
}

}  // namespace

std::optional<std::string> numbered_name(const std::string& pattern, unsigned number, size_t from) {
    const std::optional<Run> run = last_run(pattern, from);
    if (!run) return std::nullopt;
    std::string digits = std::to_string(number);
    const size_t length = run->end - run->first;
    digits.insert(0, std::max(length, digits.size()) - digits.size(), '0');
    return std::string(pattern).replace(run->first, length, digits);
}

bool is_numbered_pattern(const fs::path& pattern) {
    std::error_code error;
    return last_run(pattern.filename().string(), 0) && !fs::exists(pattern, error);
}

std::vector<fs::path> numbered_files(const fs::path& pattern) {
    const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
    const std::string name = pattern.filename().string();
    const std::optional<Run> run = last_run(name, 0);
    if (!run) fail(pattern.string(), " has no # in its name that stands for numbers");
    std::error_code error;
    std::map<unsigned, fs::path> files;
    for (fs::directory_iterator entries(folder, error); !error && entries != fs::directory_iterator();
         entries.increment(error))
        if (const auto number = number_in(entries->path().filename().string(), name, *run))
            files[*number] = pattern.parent_path() / entries->path().filename();
    if (error) fail("cannot list the folder ", folder.string(), ": ", error.message());
    if (files.empty()) fail(pattern.string(), ": no file has a name of this pattern, in which # stands for a digit");
    std::vector<fs::path> ordered;
    for (unsigned expected = files.begin()->first; const auto& [number, file] : files) {
        if (number != expected)
            fail(pattern.string(), ": the file of number ", expected, " is missing before that of number ", number);
        ++expected;
        ordered.push_back(file);
    }
    return ordered;
}
