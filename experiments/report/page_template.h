#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// A page in one file: experiments/page/frame.html around BODY.html, with the scripts and styles that the build made of
/// SCRIPT.js of the same folder. `values`: of the tags of both (mustache(5)): {{name}} is escaped for HTML, {{{name}}}
/// is put in as it is (both are empty where `values` has no such name), and a section {{#name}} ... {{/name}} is
/// repeated for each element of an array, or left out where `values` has no such name, an empty array or false. Fails
/// with Error if a template is malformed, with MachineError if the scripts were not built.
std::string page_text(const std::string& script, const std::string& body, const std::string& title,
                      nlohmann::json values);

/// A file of experiments/page, or one that the build made of its scripts and styles, as page_text() takes them.
std::string template_file(const std::string& name);
std::string built_file(const std::string& name);

/// An entry of values["elements"]: an element of the page that holds a text for its scripts, which is put in as it is.
nlohmann::json page_element(const std::string& id, const std::string& text, const std::string& type = "text/plain");

/// JSON inside a script element: no "</script>" may end it.
std::string script_text(const nlohmann::json& value);
