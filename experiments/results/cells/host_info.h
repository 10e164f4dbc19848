#pragma once
#include "experiments/results/cells/source_code.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

/// The machine: {"name", "cpu", "cores", "memory_gib", "kernel"}; for the manifest.
nlohmann::json host_info();

/// The path of this program's file.
std::filesystem::path this_program();

/// This program: {"version", "commit", "dirty", "code", "compiler", "build"}. Commit and dirty are those of the source
/// tree when it was built, as build_commit.json beside the program says; "" and false without that file. Dirty too if
/// code_hash(), which is "code", is no longer what it was then.
nlohmann::json build_info();

/// The hash of this executable and of what it reads from the source tree at run time, shaders and the tables of
/// techniques: a result computed by other code is another result.
std::string code_hash();

/// The sources that this program was compiled from, but those that it reads when it runs as they lie in the source tree
/// now: shaders, what they include, tables.
std::vector<SourceFile> present_sources();

/// UTC, ISO 8601: 2026-01-31T12:00:00Z.
std::string time_stamp();
