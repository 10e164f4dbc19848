#pragma once
#include <string>

/// What the bits of a reference depend on besides, at run time: Embree's version, the processor's level of
/// instructions, by which Embree and the C library choose their code, and that library's version.
std::string render_platform();
