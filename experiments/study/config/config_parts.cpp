#include "experiments/study/config/config_parts.h"

#include "core/error.h"
#include "metrics/metric.h"
#include "variants/registry.h"

#include <algorithm>

namespace {

/// A text, or an array of texts that is not empty.
void check_names(JsonObject& object, const std::string& key) {
    const nlohmann::json& names = object.any(key);
    const auto is_text = [](const nlohmann::json& name) { return name.is_string(); };
    if (is_text(names) || (names.is_array() && !names.empty() && std::ranges::all_of(names, is_text))) return;
    fail(object.at(key), ": '", key, "' must be a text or an array of texts, not ", shown(names));
}

void check_object(JsonObject& object, const std::string& key) {
    if (object.has(key) && !object.any(key).is_object())
        fail(object.at(key), ": '", key, "' must be an object, not ", shown(object.any(key)));
}

}  // namespace

void check_tables(JsonObject& config) {
    std::set<std::string> names;
    for (JsonObject& table : config.objects("tables")) {
        const std::string name = table.text("name");
        const auto is_plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
        if (name.empty() || !std::ranges::all_of(name, is_plain))
            fail(table.at("name"), ": 'name' = \"", name, "\" names files: letters, digits and _ are allowed");
        if (!names.insert(name).second) fail(table.where(), ": two tables are called '", name, "'");
        table.text("caption");
        table.any("of");
        table.choice(
            "of", {"effects", "results", "splits", "times", "time_effects", "hits", "limits", "agreement", "eye"}, "");
        check_object(table, "where");
        check_names(table, "rows");
        check_names(table, "columns");
        table.text("over", "");
        table.text("sort", "");
        table.choice("best", {"", "column", "row"}, "");
        check_object(table, "labels");
        table.finish();
    }
}

bool check_search(JsonObject& config, const std::vector<VariantConfig>& variants) {
    if (!config.has("search")) return false;
    JsonObject search = config.object("search");
    if (variants.size() != 1)
        fail(search.where(), ": a search needs exactly one point to start from, but 'variants' makes ",
             variants.size());
    const VariantConfig& start = variants.front();
    const nlohmann::json& axes = search.any("axes");
    if (!axes.is_object() || axes.empty())
        fail(search.at("axes"), ": 'axes' must be an object of parameter names and their values, not ", shown(axes));
    for (const auto& [name, values] : axes.items()) {
        if (!values.is_array() || values.empty())
            fail(search.at("axes"), ": axes: '", name, "' must be an array of values, not ", shown(values));
        for (const nlohmann::json& value : values) {
            nlohmann::json parameters = start.parameters;
            parameters[name] = value;
            try {
                make_variant(start.variant, parameters, start.preset);
            } catch (const Error& mistake) {
                fail(search.at("axes"), ": axes: ", mistake.what());
            }
        }
    }
    if (search.has("metrics")) check_names(search, "metrics");
    search.text("target", "");
    search.text("mask", "");
    search.integer("rounds", 1, 100, 8);
    search.number("most_time", 1.0f, 1e6f, 1e6f);
    search.number("least_gain", 0.0f, 1.0f, 0.01f);
    search.finish();
    return true;
}
