#include "experiments/study/config/points/point_name.h"

#include "core/error.h"
#include "core/files.h"
#include "core/near_miss.h"
#include "core/number_text.h"

std::string label_of(const nlohmann::json& values) {
    std::string label;
    for (const auto& [name, value] : values.items())
        label += (label.empty() ? "" : " ") + name + "=" + plain_text(value);
    return label;
}

std::string point_name(const std::string& preset, const nlohmann::json& swept) {
    constexpr size_t longest_whole = 80, longest_cut = 58, hash_digits = 16;  // 64 bits: a study has 100,000 points
    std::string name = preset;
    if (!swept.empty()) name += (preset.empty() ? "" : " ") + label_of(swept);
    if (name.empty()) return "default";
    if (name.size() <= longest_whole) return name;
    ContentHash hash;
    hash.add(name);
    const std::string end = "#" + hash.hex().substr(0, hash_digits);
    // At the last space before which the words fit; a first word that does not is cut.
    const size_t room = longest_cut - end.size() - 1, space = name.rfind(' ', room);
    return name.substr(0, space == std::string::npos ? room : space) + " " + end;
}

std::string fill_in(const std::string& text, const nlohmann::json& values, const std::string& where) {
    std::string filled;
    for (size_t at = 0; at < text.size();) {
        const size_t open = text.find('{', at), close = text.find('}', open);
        if (open == std::string::npos || close == std::string::npos) {
            filled += text.substr(at);
            break;
        }
        const std::string name = text.substr(open + 1, close - open - 1);
        if (!values.contains(name))
            fail(where, " names {", shortened(name), "}, which is not known", suggestion(name, keys_of(values)));
        const nlohmann::json& value = values[name];
        filled += text.substr(at, open - at);  // a sampled number has eight digits, which nobody reads
        filled += value.is_number_float() ? number_text(value.get<double>()) : plain_text(value);
        at = close + 1;
    }
    while (filled.ends_with(' ')) filled.pop_back();  // where the last value is empty
    return filled;
}

std::string plain_text(const nlohmann::json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}
