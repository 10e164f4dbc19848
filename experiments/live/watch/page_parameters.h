#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// The parameters that a technique declares, as the page's sliders want them: [slider_json() with "is_read"]. `initial`
/// is what the preset ("": none) gives, `value` that with `values` in its place; is_read: is_read() of the registry.
/// Values that the technique does not declare, as it did before somebody changed it, are taken out of `values`; those
/// that it refuses are Errors.
nlohmann::json page_parameters(const std::string& name, const std::string& preset, nlohmann::json& values);
