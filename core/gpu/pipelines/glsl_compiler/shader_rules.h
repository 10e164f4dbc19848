#pragma once
#include <span>
#include <string>
#include <vector>

// What a compiled shader may ask of a device. Shaders may be anybody's: those of a technique's folder are. With what
// no device of ssrlab was created for, a driver does anything, up to writing to any address of the process.

/// Capabilities and extensions in the SPIR-V that no device of ssrlab is created with, by their names; empty: none.
/// What is no SPIR-V has no device either.
std::vector<std::string> foreign_capabilities(std::span<const unsigned> spirv);
