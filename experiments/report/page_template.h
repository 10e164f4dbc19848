#pragma once
#include <nlohmann/json.hpp>
#include <span>
#include <string>

/// An element of a page that holds a text for scripts, without escapes.
struct PageElement {
    std::string id, text, type = "text/plain";
};

/// A page in one file: experiments/page/frame.html around BODY.html, with the built scripts and styles of SCRIPT.js of
/// the same folder. `values` are those of both templates' tags (mustache(5)). {{name}} is escaped for HTML, {{{name}}}
/// is not; both are empty without a value. A section {{#name}} ... {{/name}} is repeated for each element of an array;
/// without a value, or for an empty array or false, it is left out. `elements` stand where frame.html has its tag
/// {{{elements}}}. Fails with Error if a template is malformed, with MachineError if the scripts were not built.
std::string page_text(const std::string& script, const std::string& body, const std::string& title,
                      nlohmann::json values, std::span<const PageElement> elements);

/// A file of experiments/page (template_file()), or one that the build made from it (built_file()).
std::string template_file(const std::string& name);
std::string built_file(const std::string& name);

/// JSON for a script element, escaped so that no "</script>" ends it.
std::string script_text(const nlohmann::json& value);
