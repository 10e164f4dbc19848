#include "experiments/cli/request_error.h"

#include "core/list_text.h"
#include "core/near_miss.h"

#include <algorithm>

namespace {

/// "-1" is a number.
bool is_option(const std::string& word) {
    return word.size() > 1 && word[0] == '-' && !(word[1] >= '0' && word[1] <= '9') && word[1] != '.';
}

/// "CONFIG.json", "--out DIR": an argument or option as a usage line has it.
std::string written(const CLI::Option& option) {
    const std::string type = option.get_type_name(), value = type.substr(0, type.find(':'));
    return option.get_positional() ? value : option.get_name() + " " + value;
}

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options([](const CLI::Option* o) { return !o->get_group().empty(); }))
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

/// As suggestion(), but an option that begins the word, or that the word begins, is near as well: "--output" of
/// "--out".
std::string suggested_option(const std::string& word, const std::vector<std::string>& options) {
    const auto begins = [](const std::string& whole, const std::string& begin) {
        return begin.size() > 4 && whole.starts_with(begin);
    };
    const auto near = std::ranges::find_if(
        options, [&](const std::string& option) { return begins(word, option) || begins(option, word); });
    return suggestion(near == options.end() ? word : *near, options);
}

std::vector<std::string> arguments_where(const CLI::App& command, const std::function<bool(const CLI::Option*)>& fits) {
    std::vector<std::string> arguments;
    for (const CLI::Option* option : command.get_options(fits)) arguments.push_back(written(*option));
    return arguments;
}

/// Of an option with too few or too many values.
std::string mismatch(const CLI::Option& option) {
    const int least = option.get_items_expected_min(), most = option.get_items_expected_max();
    if (least > 1) return "needs " + std::to_string(least) + " values: " + written(option);
    if (int(option.count()) > most) return "was given more than once; give it once: " + written(option);
    return "needs a value: " + written(option);
}

std::string mistake(const CLI::App& command, const CLI::ParseError& refusal) {
    const std::string name = command.get_parent() ? "`ssrlab " + command.get_name() + "`" : "`ssrlab`";
    const std::vector<std::string> left_over = command.remaining();
    // An unknown option comes first: what seems to be missing may be its value.
    if (const auto unknown = std::ranges::find_if(left_over, is_option); unknown != left_over.end()) {
        const std::string option = unknown->substr(0, unknown->find('='));
        return name + " has no option '" + shortened(option) + "'" + suggested_option(option, option_names(command));
    }
    if (!left_over.empty()) {
        const std::vector<std::string> taken =
            arguments_where(command, [](const CLI::Option* option) { return option->get_positional(); });
        return "'" + shortened(left_over.front()) + "' is one argument too many; " + name + " takes " +
               (taken.empty() ? "none" : listed(taken));
    }
    if (!command.get_parent()) return "`ssrlab` needs a command";
    if (dynamic_cast<const CLI::RequiredError*>(&refusal)) {
        const std::vector<std::string> missing = arguments_where(
            command, [](const CLI::Option* option) { return option->get_required() && option->count() == 0; });
        return name + " needs " + listed(missing) + ", as in: " + command.get_footer();
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&refusal)) {
        const std::string what = refusal.what();
        for (const CLI::Option* option : command.get_options())
            if (what.starts_with(option->get_name() + ":"))
                return "option '" + option->get_name() + "' " + mismatch(*option);
    }
    return refusal.what();
}

}  // namespace

std::string request_error(const CLI::App& app, const CLI::ParseError& refusal) {
    const std::vector<const CLI::App*> chosen = app.get_subcommands([](const CLI::App* c) { return c->parsed(); });
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    const std::string asked = chosen.empty() ? "ssrlab" : "ssrlab " + command.get_name();
    const std::string sentence = mistake(command, refusal);
    return sentence + (sentence.ends_with('?') ? " See `" : "; see `") + asked + " --help`";
}
