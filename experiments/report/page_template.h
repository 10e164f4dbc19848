#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>

/// A file of experiments/report/page, from which pages are made.
std::string page_part(const std::string& name);

/// JSON inside a script element: no "</script>" may end it.
std::string script_text(const nlohmann::json& value);

/// A text with the tags of Mustache (mustache(5)), filled in: {{name}} is escaped for HTML, {{{name}}} is put in as it
/// is (both are empty where `values` has no such name), and a section {{#name}} ... {{/name}} is repeated for each
/// element of an array, or left out where `values` has no such name, an empty array or false. `partials`: the texts,
/// with tags of their own, that {{>name}} stands for. Fails with Error if the template is malformed.
std::string filled_template(const std::string& text, const nlohmann::json& values,
                            const std::map<std::string, std::string>& partials = {});
