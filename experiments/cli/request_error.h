#pragma once
#include <CLI/CLI.hpp>
#include <string>

/// What is wrong with a command line that CLI11 refused, and what to do, in one sentence: the nearest option for a
/// misspelt one, the arguments that are missing, or how many are taken.
std::string request_error(const CLI::App& app, const CLI::ParseError& refusal);
