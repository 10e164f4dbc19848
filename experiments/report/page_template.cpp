#include "experiments/report/page_template.h"

#include "core/error.h"
#include "core/files.h"

#include <kainjow/mustache.hpp>

using nlohmann::json;

std::string page_part(const std::string& name) {
    return read_text(std::filesystem::path(SSRLAB_SOURCE_DIR) / "experiments/report/page" / name);
}

std::string script_text(const json& value) {
    std::string escaped;
    for (const char c : value.dump(-1, ' ', false, json::error_handler_t::replace))
        escaped += c == '<' ? "\\u003c" : std::string(1, c);
    return escaped;
}

namespace {

kainjow::mustache::data mustache_data(const json& value) {
    using kainjow::mustache::data;
    if (value.is_object()) {
        data object;
        for (const auto& [key, part] : value.items()) object.set(key, mustache_data(part));
        return object;
    }
    if (value.is_array()) {
        data list(data::type::list);
        for (const json& part : value) list.push_back(mustache_data(part));
        return list;
    }
    if (value.is_boolean()) return data(value.get<bool>());
    return data(value.is_string() ? value.get<std::string>() : value.dump());
}

}  // namespace

std::string filled_template(const std::string& text, const json& values,
                            const std::map<std::string, std::string>& partials) {
    kainjow::mustache::mustache page(text);
    kainjow::mustache::data all = mustache_data(values);
    for (const auto& [name, partial] : partials) all.set(name, kainjow::mustache::data(partial));
    const std::string filled = page.render(all);
    if (!page.is_valid()) fail("a template of the report is malformed: ", page.error_message());
    return filled;
}
