#pragma once
#include "experiments/results/cells/source_code.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

/// The machine: {"name", "cpu", "cores", "memory_gib", "kernel"}; for the manifest.
nlohmann::json host_info();

/// The path of this program's file.
std::filesystem::path this_program();

/// This program: {"version", "commit", "dirty", "code", "compiler", "build"}. "commit" and "dirty" describe the source
/// tree at build time, from build_commit.json in built_files(); "" and false without that file. "code" is
/// code_hash(); "dirty" is also true if it has changed since the build.
nlohmann::json build_info();

/// The hash of this executable and of what it reads from own_files() at run time (shaders, tables of techniques): a
/// result computed by other code is another result.
std::string code_hash();

/// The sources that this program was compiled from. Files that it reads at run time (shaders, what they include,
/// tables) are as they are now in own_files().
std::vector<SourceFile> present_sources();

/// UTC, ISO 8601: 2026-01-31T12:00:00Z.
std::string time_stamp();
