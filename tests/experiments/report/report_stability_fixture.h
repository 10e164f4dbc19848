#pragma once
#include <filesystem>

/// Writes the tables of `ssrlab stability` as a made-up run of four techniques in five cases leaves them: one row of
/// each verdict, a stage that fails as failures.json says, one that is only passed what failed, and one that nobody
/// knows.
void write_stability_fixture(const std::filesystem::path& folder);
