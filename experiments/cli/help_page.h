#pragma once
#include <CLI/CLI.hpp>

/// What `ssrlab --help` and `ssrlab COMMAND --help` print, in the width of the terminal: the commands in their groups,
/// each group with its first command's example; of a command its example, its arguments and its options.
class HelpPage : public CLI::Formatter {
public:
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
    std::string make_usage(const CLI::App* app, std::string name) const override;
    std::string make_group(std::string group, bool is_positional,
                           std::vector<const CLI::Option*> options) const override;
    std::string make_option(const CLI::Option* option, bool is_positional) const override;
    std::string make_subcommands(const CLI::App* app, CLI::AppFormatMode mode) const override;
};

/// The line "For example: ssrlab run quickstart" of a command.
std::string example_line(const CLI::App& command);
