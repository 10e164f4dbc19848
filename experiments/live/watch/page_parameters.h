#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// A technique's declared parameters for the page's sliders: [slider_json() with "is_read"]. `initial`: the preset's
/// value ("": the default); `value`: overridden by `values`; is_read: is_read() of the registry. Removes from `values`
/// what the technique does not declare, as its declaration may have changed. Fails with Error on values that it
/// refuses.
nlohmann::json page_parameters(const std::string& name, const std::string& preset, nlohmann::json& values);
