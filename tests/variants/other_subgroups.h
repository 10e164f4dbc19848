#pragma once
#include "core/exr/exr.h"

/// lavapipe's subgroups have as many lanes as its vectors have floats: 4, 8 or 16.
inline constexpr const char* vector_widths[] = {"128", "256", "512"};

/// What a disabled test of this program writes to the file that the environment names, run in a process of its own with
/// vectors of `bits`.
LayeredImage written_with_vectors_of(const std::string& bits, const std::string& disabled_test);

/// For the disabled test.
void write_for_caller(const LayeredImage& image);
