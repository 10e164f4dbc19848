#include "experiments/study/config/points/design.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "experiments/study/config/points/unit_samples.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace {

using nlohmann::json;

const Parameter& find_parameter(const ParameterSet& declared, const std::string& name, const std::string& where) {
    return find_named(declared, name, ListedBy{"ssrlab describe TECHNIQUE"}, where, ": unknown parameter");
}

/// The number as the parameter holds it: in whole steps, or as a float32.
json rounded(const Parameter& p, double value) {
    if (p.glsl_type == "float") return json_number(float(value));
    return std::llround(value);
}

/// {"lin": [a, b]} or {"log": [a, b]}.
struct Range {
    double from, to;
    bool is_log;

    double at(double share) const {  // share in [0, 1]
        return is_log ? from * std::pow(to / from, share) : from + (to - from) * share;
    }
};

/// An axis: an array of such values, or, where they are numbers, a range with `more` numbers behind its ends.
Values axis_of(const json& value, const std::string& values_text, bool has_range, int more) {
    const Values values = {array_of({value, "", {}}).schema, "an array of values" + values_text, {}};
    const auto range = [&](const char* kind) {
        return Values{schema_of({{kind, range_values(more), required, ""}}),
                      "`{\"" + std::string(kind) + "\": " + range_values(more).text + "}`",
                      {}};
    };
    return has_range ? either(either(values, range("lin")), range("log")) : values;
}

void check_axis(const json& axis, const Parameter& p, const std::string& at, int more) {
    const bool is_number = p.choices.empty() && p.glsl_type != "bool";
    check(axis, axis_of(json::object(), is_number ? "" : " (" + p.range_text() + ")", is_number, more), p.name, at);
}

/// Of an axis that is one, as check_axis() says.
Range read_range(const json& axis, const std::string& where) {
    const bool is_log = axis.contains("log");
    const json& numbers = axis.front();
    const Range range{numbers[0].get<double>(), numbers[1].get<double>(), is_log};
    if (range.from == range.to)
        fail(where, ": both ends of the range are ", shown(numbers[0]), "; give two different ends");
    if (is_log && !(range.from > 0 && range.to > 0))
        fail(where, ": 'log' needs ends above 0, not ", shown(numbers), "; give 0 a point of its own");
    return range;
}

std::vector<json> axis_values(JsonObject& axes, const std::string& name, const ParameterSet& declared) {
    const std::string at = axes.at(name), where = at + ": '" + name + "'";
    const Parameter& p = find_parameter(declared, name, at);
    const json& axis = axes.any(name);
    check_axis(axis, p, at, 1);
    std::vector<json> values;
    if (axis.is_array()) {
        for (const json& value : axis) values.push_back(p.in_its_type(value));
    } else {
        const Range range = read_range(axis, where);
        const json& count = axis.front()[2];
        if (!is_whole(count) || count < 2 || count > most_points)
            fail(where, ": the count must be a whole number in [2, ", most_points, "], not ", shown(count));
        const size_t n = count.get<size_t>();
        for (size_t i = 0; i < n; ++i) values.push_back(rounded(p, range.at(double(i) / double(n - 1))));
        values.erase(std::unique(values.begin(), values.end()), values.end());  // whole numbers that lie close
    }
    if (!axis.is_array()) {  // the others lie between
        for (const json& end : {values.front(), values.back()}) checked_value(declared, name, end, at);
    } else {
        for (const json& value : values) checked_value(declared, name, value, at);
    }
    return values;
}

void refuse_too_many(double points, const std::string& design, const std::string& where) {
    if (points > double(most_points))
        fail(where, ": '", design, "' makes ", points, " points; at most ", most_points, " are allowed");
}

using Axes = std::vector<std::pair<std::string, std::vector<json>>>;

/// In the order of the names, as JSON objects have them.
Axes read_axes(JsonObject& object, const std::vector<std::string>& names, const ParameterSet& declared) {
    Axes axes;
    for (const std::string& name : names) axes.emplace_back(name, axis_values(object, name, declared));
    return axes;
}

std::vector<json> all_combinations(const Axes& axes, const std::string& where) {
    double count = 1;
    for (const auto& [name, values] : axes) count *= double(values.size());
    refuse_too_many(count, "sweep", where);
    std::vector<json> points = {json::object()};
    for (const auto& [name, values] : axes) {
        std::vector<json> longer;
        for (const json& point : points)
            for (const json& value : values) {
                longer.push_back(point);
                longer.back()[name] = value;
            }
        points = std::move(longer);
    }
    return points;
}

std::vector<json> zipped(const Axes& axes, const std::string& where) {
    std::vector<json> points(axes.front().second.size(), json::object());
    for (const auto& [name, values] : axes) {
        if (values.size() != points.size())
            fail(where, ": 'zip' pairs values, but '", axes.front().first, "' has ", points.size(), " and '", name,
                 "' has ", values.size());
        for (size_t i = 0; i < points.size(); ++i) points[i][name] = values[i];
    }
    return points;
}

std::vector<json> single_values(const Axes& axes, const ParameterSet& declared) {
    std::vector<json> points;
    for (const Parameter& p : declared)
        for (const auto& [name, values] : axes)
            if (name == p.name)
                for (const json& value : values) points.push_back({{name, value}});
    return points;
}

/// What an axis of a sample makes of a number in [0, 1). Whole numbers and listed values get equal shares.
json sampled_value(const json& axis, const Parameter& p, const std::optional<Range>& range, double u) {
    if (!range) return p.in_its_type(axis[size_t(u * double(axis.size()))]);
    if (p.glsl_type == "float") return rounded(p, range->at(u));
    const double low = std::min(range->from, range->to), high = std::max(range->from, range->to);
    return int64_t(std::min(std::floor(Range{low, high + 1, range->is_log}.at(u)), high));
}

/// The range of a sample's axis, whose ends the parameter may have; none of one that lists values.
std::optional<Range> read_sample_axis(const json& axis, const ParameterSet& declared, const std::string& name,
                                      const std::string& at) {
    const std::string where = at + ": '" + name + "'";
    const Parameter& p = find_parameter(declared, name, at);
    std::optional<Range> range;
    check_axis(axis, p, at, 0);
    if (!axis.is_array()) range = read_range(axis, where);
    const std::vector<json> extremes =
        range ? std::vector{rounded(p, range->from), rounded(p, range->to)} : axis.get<std::vector<json>>();
    for (const json& value : extremes) checked_value(declared, name, value, at);
    return range;
}

/// Of each parameter an array of its values, or of numbers a range with `more` numbers behind its ends.
Values axes_of(const ParameterSet& declared, int more) {
    Values axes = {declared.schema(), "an object of axes", {}, {{"type", "object"}}};
    for (auto& [name, schema] : axes.schema["properties"].items()) {
        const json description = schema["description"];
        schema = axis_of(schema, "", schema.contains("minimum"), more).schema;
        schema["description"] = description;
    }
    return axes;
}

const std::map<std::string, std::string> sample_kinds = {
    {"random", "Draw points at random"},
    {"latin_hypercube", "Draw points by a Latin hypercube: each of `count` equal parts of every axis holds one point"},
    {"sobol",
     "Draw points of Sobol's sequence (Joe and Kuo 2008, shifted by the seed). A `count` that is a power of two covers "
     "several axes evenly"}};

Keys sample_keys(const ParameterSet& declared) {
    return {{"count", whole(1, int(most_points)), required, "Number of points"},
            {"seed", whole(0, 1 << 30), 0, "Seed; the same seed gives the same points"},
            {"axes", axes_of(declared, 0), required,
             "For each parameter, a range `{\"lin\": [from, to]}` or `{\"log\": [from, to]}`, or an array of values"}};
}

std::vector<json> sampled(ConfigObject design, const std::string& kind, const ParameterSet& declared) {
    const auto count = design.get<size_t>("count");
    const auto seed = design.get<uint32_t>("seed");
    const JsonObject object = design.plain("axes");
    const json& axes = design["axes"];
    if (axes.empty()) fail(object.where(), ": is empty; name parameters and their ranges");
    const size_t dimensions = axes.size();
    const UnitSamples samples = kind == "random"  ? random_samples(count, dimensions, seed)
                                : kind == "sobol" ? sobol_samples(count, dimensions, seed)
                                                  : latin_hypercube_samples(count, dimensions, seed);
    std::vector<json> points(count, json::object());
    size_t dimension = 0;
    for (const auto& [name, axis] : axes.items()) {
        const std::optional<Range> range = read_sample_axis(axis, declared, name, object.at(name));
        const Parameter& p = find_parameter(declared, name, object.at(name));
        for (size_t i = 0; i < count; ++i) points[i][name] = sampled_value(axis, p, range, samples[i][dimension]);
        ++dimension;
    }
    std::set<json> seen;
    std::erase_if(points, [&](const json& point) { return !seen.insert(point).second; });
    return points;
}

}  // namespace

Values range_values(int more) {
    Values range = array_of({{{"type", "number"}}, "", {}}, 2 + more);
    range.schema["maxItems"] = 2 + more;
    return named(range, more ? "[from, to, count]" : "[from, to]");
}

Keys design_keys(const ParameterSet& declared) {
    const Values axes = axes_of(declared, 1);
    Keys keys = {
        {"sweep", axes, none, "Use all combinations of the axes' values"},
        {"zip", axes, none,
         "Use the first values of all axes together, then the second values, and so on. All axes have the same length"},
        {"each", axes, none, "Use each value alone: each point changes one parameter"}};
    for (const auto& [kind, meaning] : sample_kinds)
        keys.push_back({kind, object_of(sample_keys(declared)), none, meaning});
    return keys;
}

std::vector<json> read_design(ConfigObject& entry, const ParameterSet& declared) {
    std::string design;
    for (const Key& key : design_keys({})) {
        if (!entry.has(key.name)) continue;
        if (!design.empty())
            fail(entry.at(key.name), ": '", design, "' and '", key.name, "' exclude one another; write two entries");
        design = key.name;
    }
    if (design.empty()) return {json::object()};
    if (sample_kinds.contains(design)) return sampled(entry.object(design), design, declared);
    JsonObject object = entry.plain(design);
    const std::vector<std::string> names = keys_of(entry[design]);
    if (names.empty() && design == "sweep") return {json::object()};
    if (names.empty()) fail(entry.at(design), ": '", design, "' is empty; name parameters with the values to try");
    const Axes axes = read_axes(object, names, declared);
    if (design == "sweep") return all_combinations(axes, entry.at(design));
    return design == "zip" ? zipped(axes, entry.at(design)) : single_values(axes, declared);
}

void check_sample_axis(const json& axis, const ParameterSet& declared, const std::string& name, const std::string& at) {
    read_sample_axis(axis, declared, name, at);
}

json checked_value(const ParameterSet& declared, const std::string& name, const json& value, const std::string& where) {
    const Parameter& parameter = find_parameter(declared, name, where);
    ParameterSet copy = declared;
    try {
        copy.assign({{name, value}});
    } catch (const Error& e) {
        fail(where, ": ", e.what());
    }
    return parameter.in_its_type(value);
}
