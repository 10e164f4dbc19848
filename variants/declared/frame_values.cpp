#include "variants/declared/frame_values.h"

#include <algorithm>
#include <cmath>
#include <random>

using nlohmann::json;

namespace {

std::vector<const Condition*> conditions_of(const Technique& technique) {
    std::vector<const Condition*> all = {&technique.draws_random_numbers};
    for (const DeclaredImage& image : technique.images) all.push_back(&image.when);
    for (const DeclaredBuffer& buffer : technique.buffers) all.push_back(&buffer.when);
    for (const DeclaredPass& pass : technique.passes) {
        all.push_back(&pass.when);
        for (const std::optional<DeclaredTest>* test : {&pass.depth, &pass.stencil})
            if (*test) all.push_back(&(*test)->when);
        for (const std::vector<DeclaredUse>* uses : {&pass.reads, &pass.writes})
            for (const DeclaredUse& use : *uses) all.push_back(&use.when);
    }
    for (const DeclaredResult& result : technique.results) all.push_back(&result.when);
    return all;
}

/// All numbers within a test.
void add_numbers(const json& test, std::vector<double>& numbers) {
    if (test.is_number()) numbers.push_back(test.get<double>());
    if (test.is_structured())
        for (const json& part : test) add_numbers(part, numbers);
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
std::map<std::string, std::vector<json>> values_that_matter(const Technique& technique, const ParameterSet& params,
                                                            const KnownValues& defaults) {
    std::map<std::string, std::vector<double>> numbers;
    for (const Condition* condition : conditions_of(technique))
        for (const auto& [name, test] : condition->members().items()) add_numbers(test, numbers[name]);
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
                if (choice != initial) values[name].push_back(choice);
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

std::vector<FrameValues> representative_frames(const Technique& technique, const ParameterSet& params) {
    constexpr size_t most_frames = 1000;
    const KnownValues defaults(params);
    const auto values = values_that_matter(technique, params, defaults);
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
    }
    return frames;
}
