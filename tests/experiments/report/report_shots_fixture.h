#pragma once
#include <cstddef>
#include <filesystem>

/// A made-up results folder of many shots with 20 points each: two errors of two targets under three masks, splits,
/// rays, shares of the error, and times of four stages. Each shot has an image of 2x2 pixels of two points and the
/// truth.
void write_shots_fixture(const std::filesystem::path& folder, size_t shots);
