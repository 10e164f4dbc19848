#include "experiments/config/point_name.h"

#include "core/files.h"
#include "experiments/config/config_values.h"

std::string label_of(const nlohmann::json& values) {
    std::string label;
    for (const auto& [name, value] : values.items())
        label += (label.empty() ? "" : " ") + name + "=" + plain_text(value);
    return label;
}

std::string point_name(const std::string& preset, const nlohmann::json& swept) {
    constexpr size_t longest_whole = 80, longest_cut = 48, hash_digits = 6;
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
