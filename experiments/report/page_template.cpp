#include "experiments/report/page_template.h"

#include "core/error.h"
#include "core/files.h"
#include "core/own_files.h"

#include <kainjow/mustache.hpp>

using nlohmann::json;

std::string script_text(const json& value) {
    const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    std::string escaped;
    escaped.reserve(text.size());
    size_t from = 0;
    for (size_t at; (at = text.find('<', from)) != std::string::npos; from = at + 1)
        escaped.append(text, from, at - from).append("\\u003c");
    return escaped.append(text, from);
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

std::string template_file(const std::string& name) { return read_text(own_files() / "experiments/page" / name); }

/// What the build makes of the scripts and styles.
std::string built_file(const std::string& name) {
    const std::string file = (built_files() / "pages" / name).string();
    if (!std::filesystem::exists(file))
        fail_machine(file, " is missing; the build makes it: cmake --build with the target `pages`");
    return read_text(file);
}

std::string page_text(const std::string& script, const std::string& body, const std::string& title, json values,
                      std::span<const PageElement> elements) {
    values["title"] = title;
    values["style"] = built_file(script + ".css");
    values["script"] = built_file(script + ".js");
    kainjow::mustache::data all = mustache_data(values);
    all.set("body", template_file(body + ".html"));
    all.set("no_scripts", template_file("no_scripts.html"));
    const auto filled = [&](const std::string& text) {
        kainjow::mustache::mustache part(text);
        const std::string result = part.render(all);
        if (!part.is_valid()) fail("a template of pages is malformed: ", part.error_message());
        return result;
    };
    // Elements may hold tens of megabytes, which the template's renderer would copy several times.
    const std::string frame = template_file("frame.html"), tag = "{{{elements}}}\n";
    const size_t place = frame.find(tag);
    if (place == std::string::npos) fail("a template of pages is malformed: frame.html has no ", tag);
    std::string page = filled(frame.substr(0, place));
    const std::string end = filled(frame.substr(place + tag.size()));
    size_t bytes = page.size() + end.size();
    for (const PageElement& e : elements) bytes += e.text.size() + 200;  // with room for its tags
    page.reserve(bytes);
    for (const PageElement& e : elements)
        page.append("<script type=\"" + e.type + "\" id=\"" + e.id + "\">").append(e.text).append("</script>\n");
    return page.append(end);
}
