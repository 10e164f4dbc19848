#include "variants/passes/frame_values.h"

#include <algorithm>
#include <cmath>
#include <random>

using nlohmann::json;

namespace {

std::vector<const Condition*> conditions_of(const Declaration& declaration) {
    std::vector<const Condition*> all = {&declaration.draws_random_numbers};
    const auto add = [&](const auto& of) {
        for (const auto& one : of) all.push_back(&one.when);
    };
    for (const NamedCondition& named : declaration.conditions) all.push_back(&named.condition);
    add(declaration.images), add(declaration.buffers), add(declaration.results), add(declaration.passes);
    for (const DeclaredPass& pass : declaration.passes) {
        add(pass.reads), add(pass.writes), add(pass.depth), add(pass.stencil), add(pass.over);
        for (const DeclaredLeftOut& one : pass.left_out)
            if (one.part.empty()) all.push_back(&one.when);
    }
    return all;
}

/// All numbers within a test, and the default of parameters that it names as limits.
void add_numbers(const json& test, const KnownValues& defaults, std::vector<double>& numbers) {
    if (test.is_number()) numbers.push_back(test.get<double>());
    if (test.is_string() && defaults.by_name().contains(test))
        add_numbers(defaults.by_name()[test.get<std::string>()], defaults, numbers);
    if (test.is_structured())
        for (const json& part : test) add_numbers(part, defaults, numbers);
}

/// Values on both sides of what the tests compare with, and the one that there is. `parameter`: null for a fact of a
/// shot.
std::vector<json> sides_of(const std::vector<double>& numbers, const json& initial, const Parameter* parameter) {
    std::vector<json> values = {initial};
    const bool is_whole = parameter && parameter->glsl_type != "float";
    for (const double number : numbers)
        for (const int side : {-1, 0, 1}) {
            if (std::abs(number) > 1e15) continue;  // beyond what a parameter holds
            const double step = is_whole ? 1.0 : std::max(1e-4 * std::abs(number), 1e-4);
            const json value = is_whole ? json(int64_t(number) + side) : json_number(float(number + side * step));
            const bool fits = parameter ? value >= parameter->min && value <= parameter->max : value >= 0 && value <= 1;
            if (fits && std::ranges::find(values, value) == values.end()) values.push_back(value);
        }
    return values;
}

/// The values that matter of each name that a condition has, its default first.
std::map<std::string, std::vector<json>> values_that_matter(const Declaration& declaration, const ParameterSet& params,
                                                            const KnownValues& defaults) {
    std::map<std::string, std::vector<double>> numbers;
    for (const Condition* condition : conditions_of(declaration))
        for (const json& members : condition->alternatives())
            for (const auto& [name, test] : members.items())
                if (!std::ranges::count(declaration.conditions, name, &NamedCondition::name))
                    add_numbers(test, defaults, numbers[name]);
    std::map<std::string, std::vector<json>> values;
    for (const auto& [name, compared] : numbers) {
        const json& initial = defaults.by_name().at(name);
        const auto found = std::ranges::find(params, name, &Parameter::name);
        const Parameter* parameter = found == params.end() ? nullptr : &*found;
        if (initial.is_boolean()) {
            values[name] = {initial, initial != true};
        } else if (initial.is_string()) {
            values[name] = {initial};
            for (const std::string& choice : parameter->choices)
                if (initial != choice) values[name].push_back(choice);
        } else {
            values[name] = sides_of(compared, initial, parameter);
        }
    }
    return values;
}

}  // namespace

void FrameValues::set(const std::string& name, const json& value) {
    if (known_.by_name().at(name) == value) return;
    known_.set(name, value);
    changed_[name] = name + " is " + (value.is_string() ? "'" + value.get<std::string>() + "'" : value.dump());
}

std::string FrameValues::text() const {
    std::string list;
    for (const auto& [name, text] : changed_) list += (list.empty() ? ", where " : " and ") + text;
    return list;
}

std::vector<FrameValues> representative_frames(const Declaration& declaration, const ParameterSet& params) {
    constexpr size_t most_frames = 1000;
    KnownValues defaults(params);
    defaults.derive(declaration.conditions);
    defaults.know_shot();
    const auto values = values_that_matter(declaration, params, defaults);
    size_t count = 1;
    for (const auto& [name, of_name] : values) count = std::min(count * of_name.size(), most_frames + 1);
    std::vector<FrameValues> frames;
    std::mt19937 random(1);
    for (size_t i = 0; i < std::min(count, most_frames); ++i) {
        FrameValues& frame = frames.emplace_back(defaults);
        size_t rest = i;
        for (const auto& [name, of_name] : values) {
            const bool is_sampled = count > most_frames && i > 0;
            frame.set(name, of_name[(is_sampled ? random() : rest) % of_name.size()]);
            rest /= of_name.size();
        }
        frame.derive(declaration.conditions);
    }
    return frames;
}
