#include "experiments/cli/help_page.h"

#include "core/terminal.h"
#include "core/wrapped_text.h"

namespace {

constexpr size_t name_columns = 34, command_columns = 18;  ///< where meanings begin

std::optional<size_t> columns() { return terminal_columns(stdout); }

/// A text of several lines, each wrapped.
std::string paragraphs(const std::string& text) {
    std::string wrapped_lines;
    for (const std::string& line : CLI::detail::split(text, '\n')) wrapped_lines += wrapped(line, 0, columns());
    return wrapped_lines;
}

}  // namespace

std::string example_line(const CLI::App& command) {
    return wrapped("For example: " + command.get_footer(), 0, columns());
}

std::string HelpPage::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    const bool is_command = app->get_parent() != nullptr;
    return (is_command ? example_line(*app) + '\n' : "") + paragraphs(app->get_description()) + '\n' +
           make_usage(app, name) + make_positionals(app) + (is_command ? "" : make_subcommands(app, mode)) +
           make_groups(app, mode);
}

std::string HelpPage::make_usage(const CLI::App* app, std::string) const {
    if (!app->get_parent())
        return wrapped("Usage: ssrlab COMMAND [ARGUMENTS]. `ssrlab COMMAND --help` explains a command.", 0, columns());
    std::string usage = "Usage: ssrlab " + app->get_name() + " [OPTIONS]";
    for (const CLI::Option* argument : app->get_options([](const CLI::Option* o) { return o->get_positional(); }))
        usage += " " + make_option_usage(argument);
    return wrapped(usage, 0, columns());
}

std::string HelpPage::make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> options) const {
    std::string lines = "\n" + heading((is_positional ? "Arguments" : group) + ":") + "\n";
    for (const CLI::Option* option : options) lines += make_option(option, is_positional);
    return lines;
}

std::string HelpPage::make_option(const CLI::Option* option, bool is_positional) const {
    return beside("  " + make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option),
                  name_columns, columns());
}

std::string HelpPage::make_subcommands(const CLI::App* app, CLI::AppFormatMode) const {
    std::string lines, group;
    for (const CLI::App* command : app->get_subcommands({})) {
        if (command->get_group() != group) {
            group = command->get_group();
            lines += "\n" + heading(group) + "\n" + wrapped("for example: " + command->get_footer(), 2, columns());
        }
        lines += beside("  " + command->get_name(), command->get_description(), command_columns, columns());
    }
    return lines;
}
