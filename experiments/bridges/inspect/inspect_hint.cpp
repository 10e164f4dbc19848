#include "experiments/bridges/inspect/inspect_hint.h"

#include "core/image_format.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace {

/// Of files that `ssrlab inspect` shows more of than their reader's message says.
constexpr const char* inspected_endings[] = {".gltf", ".glb", ".exr", ".png", ".jpg", ".jpeg", ".hdr"};

bool is_inspected_file(const std::string& path) {
    std::error_code error;
    return std::filesystem::is_regular_file(path, error);
}

/// The longest name of such a file that ends at `end`; names begin with a message, a word or a quotation.
std::string file_that_ends_at(const std::string& message, size_t end) {
    constexpr size_t longest = 4096, most_tries = 64;  // a message may quote anything
    const size_t least = end > longest ? end - longest : 0;
    std::string found;
    size_t tries = 0;
    for (size_t begin = end; begin-- > least && tries < most_tries;) {
        if (begin > 0 && std::string_view(" '\"`(").find(message[begin - 1]) == std::string_view::npos) continue;
        ++tries;
        if (const std::string path = message.substr(begin, end - begin); is_inspected_file(path)) found = path;
    }
    return found;
}

}  // namespace

std::string inspect_hint(const std::string& message) {
    std::string lower = message;
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    for (size_t dot = lower.find('.'); dot != std::string::npos; dot = lower.find('.', dot + 1))
        for (const std::string ending : inspected_endings) {
            const size_t end = dot + ending.size();
            if (lower.compare(dot, ending.size(), ending) != 0) continue;
            if (end < lower.size() && std::isalnum(static_cast<unsigned char>(lower[end]))) continue;
            if (const std::string file = file_that_ends_at(message, end); !file.empty())
                return "`ssrlab inspect " + quoted_for_shell(file) + "` shows what ssrlab understands of the file";
        }
    return {};
}
