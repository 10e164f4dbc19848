#include "experiments/report/html_template.h"

#include "core/error.h"

#include <kainjow/mustache.hpp>

namespace {

using kainjow::mustache::data;
using nlohmann::json;

data mustache_data(const json& value) {
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
    data all = mustache_data(values);
    for (const auto& [name, partial] : partials) all.set(name, data(partial));
    const std::string filled = page.render(all);
    if (!page.is_valid()) fail("a template of the report is malformed: ", page.error_message());
    return filled;
}
