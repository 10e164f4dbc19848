#include "experiments/report/page_template.h"

#include "core/error.h"
#include "core/files.h"

#include <kainjow/mustache.hpp>

using nlohmann::json;

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

std::string template_file(const std::string& name) {
    return read_text(std::filesystem::path(SSRLAB_SOURCE_DIR) / "experiments/page" / name);
}

/// SSRLAB_PAGES is where the build puts what it makes of the scripts and styles.
std::string built_file(const std::string& name) {
    const std::string file = SSRLAB_PAGES "/" + name;
    if (!std::filesystem::exists(file))
        fail_machine(file, " is missing; the build makes it: cmake --build with the target `pages`");
    return read_text(file);
}

std::string page_text(const std::string& script, const std::string& body, const std::string& title, json values) {
    values["title"] = title;
    values["style"] = built_file(script + ".css");
    values["script"] = built_file(script + ".js");
    kainjow::mustache::mustache page(template_file("frame.html"));
    kainjow::mustache::data all = mustache_data(values);
    all.set("body", template_file(body + ".html"));
    all.set("no_scripts", template_file("no_scripts.html"));
    const std::string filled = page.render(all);
    if (!page.is_valid()) fail("a template of pages is malformed: ", page.error_message());
    return filled;
}

json page_element(const std::string& id, const std::string& text, const std::string& type) {
    return {{"id", id}, {"text", text}, {"type", type}};
}
