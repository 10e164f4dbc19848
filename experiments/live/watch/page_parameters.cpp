#include "experiments/live/watch/page_parameters.h"

#include "experiments/live/record/sliders.h"
#include "variants/registry.h"

using nlohmann::json;

json page_parameters(const std::string& technique, const std::string& preset, json& values) {
    const auto plain = make_variant(technique, json::object(), preset);
    json known = json::object();
    for (const Parameter& p : plain->params)
        if (values.contains(p.name)) known[p.name] = values[p.name];
    values = known;
    const auto variant = make_variant(technique, values, preset);
    json parameters = json::array();
    auto initial = plain->params.begin();
    for (const Parameter& p : variant->params) {
        json one = slider_json(p);
        one["initial"] = (initial++)->value;
        one["is_read"] = is_read(variant->params, p.name);
        parameters.push_back(std::move(one));
    }
    return parameters;
}
