#include "experiments/live/watch/page_parameters.h"

#include "experiments/live/record/sliders.h"
#include "variants/registry.h"

using nlohmann::json;

json page_parameters(const std::string& name, const std::string& preset, json& values) {
    const auto plain = make_technique(name, json::object(), preset);
    json known = json::object();
    for (const Parameter& p : plain->params)
        if (values.contains(p.name)) known[p.name] = values[p.name];
    values = known;
    const auto technique = make_technique(name, values, preset);
    json parameters = json::array();
    auto initial = plain->params.begin();
    for (const Parameter& p : technique->params) {
        json one = slider_json(p);
        one["initial"] = (initial++)->value;
        one["is_read"] = is_read(technique->params, p.name);
        parameters.push_back(std::move(one));
    }
    return parameters;
}
