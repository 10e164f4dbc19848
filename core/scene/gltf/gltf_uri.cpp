#include "core/scene/gltf/gltf_uri.h"

#include "core/error.h"
#include "core/files.h"
#include "core/near_miss.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace fs = std::filesystem;

namespace {

bool equal_but_case(std::string_view text, std::string_view lower) {
    return std::ranges::equal(text, lower, [](char a, char b) { return std::tolower(uint8_t(a)) == b; });
}

/// The parts of a data URI: "data:image/png;charset=utf-8;base64,iVBOR...".
struct DataUri {
    std::string_view media_type;
    bool is_base64 = false, has_comma = false;
    std::string_view data;
};

DataUri split_data_uri(std::string_view uri) {
    DataUri parts;
    const size_t begin = std::string_view("data:").size(), comma = uri.find(',');
    parts.has_comma = comma != std::string_view::npos;
    const std::string_view head = uri.substr(begin, parts.has_comma ? comma - begin : 0);
    parts.media_type = head.substr(0, head.find(';'));
    if (const size_t last = head.rfind(';'); last != std::string_view::npos) {
        std::string_view option = head.substr(last + 1);
        while (option.starts_with(' ')) option.remove_prefix(1);
        while (option.ends_with(' ')) option.remove_suffix(1);
        parts.is_base64 = equal_but_case(option, "base64");
    }
    if (parts.has_comma) parts.data = uri.substr(comma + 1);
    return parts;
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const int lower = std::tolower(uint8_t(c));
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// RFC 3986, section 2.1; a '%' that no two digits follow stands for itself.
std::string percent_decoded(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        const bool is_escape =
            text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0;
        decoded += is_escape ? char(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])) : text[i];
        if (is_escape) i += 2;
    }
    return decoded;
}

/// RFC 4648, section 4. Line breaks and blanks are passed by, and '=' may be missing, as in web browsers.
std::string base64_decoded(std::string_view text, const std::string& what) {
    static const std::array<int8_t, 256> value_of = [] {
        std::array<int8_t, 256> values;
        values.fill(-1);
        const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (size_t i = 0; i < digits.size(); ++i) values[uint8_t(digits[i])] = int8_t(i);
        return values;
    }();
    std::string bytes(text.size() / 4 * 3 + 3, '\0');
    char* out = bytes.data();
    uint32_t group = 0;
    unsigned count = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        const int value = value_of[uint8_t(text[i])];
        if (value < 0) {
            if (std::isspace(uint8_t(text[i]))) continue;
            if (text[i] == '=' && text.find_first_not_of("= \t\r\n", i) == std::string_view::npos) break;
            fail(what, ": letter ", i + 1, " of its data is no base64");
        }
        group = group << 6 | uint32_t(value);
        if (++count % 4 == 0) *out++ = char(group >> 16), *out++ = char(group >> 8), *out++ = char(group);
    }
    if (count % 4 == 1) fail(what, ": its data are cut: ", count, " letters are no whole number of bytes in base64");
    if (count % 4 == 2) *out++ = char(group >> 4);
    if (count % 4 == 3) *out++ = char(group >> 10), *out++ = char(group >> 2);
    bytes.resize(size_t(out - bytes.data()));
    return bytes;
}

/// "http" of "http://...": a letter, then letters, digits, '+', '-' and '.' before the first ':' (RFC 3986,
/// section 3.1). One letter is the drive of a Windows path.
std::string_view scheme_of(std::string_view uri) {
    const size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon < 2 || !std::isalpha(uint8_t(uri[0]))) return {};
    const std::string_view scheme = uri.substr(0, colon);
    const bool fits = std::ranges::all_of(
        scheme, [](char c) { return std::isalnum(uint8_t(c)) || c == '+' || c == '-' || c == '.'; });
    return fits ? scheme : std::string_view();
}

}  // namespace

bool is_data_uri(std::string_view uri) { return equal_but_case(uri.substr(0, 5), "data:"); }

std::string shown_uri(const std::string& uri) {
    if (!is_data_uri(uri)) return shortened(uri);
    const DataUri parts = split_data_uri(uri);
    size_t padding = 0;
    while (padding < std::min<size_t>(parts.data.size(), 2) && parts.data[parts.data.size() - 1 - padding] == '=')
        ++padding;
    const size_t bytes = parts.is_base64 ? (parts.data.size() - padding) * 3 / 4 : parts.data.size();
    return "data:" + shortened(std::string(parts.media_type)) + " (" + std::to_string(bytes) + " bytes)";
}

std::string decode_data_uri(std::string_view uri, const std::string& what) {
    const DataUri parts = split_data_uri(uri);
    if (!parts.has_comma) fail(what, ": a data URI has a comma before its data (RFC 2397), but this one has none");
    const bool is_escaped = parts.data.find('%') != std::string_view::npos;
    if (!parts.is_base64) return percent_decoded(parts.data);
    return is_escaped ? base64_decoded(percent_decoded(parts.data), what) : base64_decoded(parts.data, what);
}

fs::path file_of_uri(const fs::path& folder, const std::string& uri, const std::string& named_by) {
    const auto exists = [&](const std::string& name) {
        std::error_code error;
        return name.find('\0') == std::string::npos && fs::exists(folder / name, error);
    };
    std::vector<std::string> names = {percent_decoded(uri), uri};
    for (size_t i = 0; i < 2; ++i) {
        std::string& slashed = names.emplace_back(names[i]);
        std::ranges::replace(slashed, '\\', '/');
    }
    const auto found = std::ranges::find_if(names, exists);
    if (const std::string_view scheme = scheme_of(uri); found == names.end() && !scheme.empty())
        fail(named_by, ": '", shortened(uri), "' is a URI of the scheme '", scheme,
             "'; files are read from the folder of the glTF only: put the file there and name it by its name");
    const std::string& name = found == names.end() ? names.front() : *found;
    if (name.find('\0') != std::string::npos)
        fail(named_by, ": '", shortened(uri), "' names no file: it holds a byte of 0");
    return file_below(folder, name, named_by);
}

std::string read_uri(const fs::path& folder, const std::string& uri, const std::string& what) {
    if (is_data_uri(uri)) return decode_data_uri(uri, what);
    const fs::path file = file_of_uri(folder, uri, what);
    try {
        return read_text(file);
    } catch (const MachineError&) {
        throw;
    } catch (const Error& e) {
        fail(what, ": ", e.what());
    }
}
