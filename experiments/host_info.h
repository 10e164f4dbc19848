#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// The machine: {"cpu", "cores", "memory_gib", "kernel"}; for the manifest.
nlohmann::json host_info();

/// This program: {"version", "commit", "dirty", "compiler", "build"}. Commit and dirty are those of the source tree
/// when it was built, as build_commit.json beside the program says; "" and false without that file.
nlohmann::json build_info();

/// The hash of this executable and of all shader sources: a result computed by other code is another result.
std::string code_hash();

/// UTC, ISO 8601: 2026-01-31T12:00:00Z.
std::string time_stamp();
