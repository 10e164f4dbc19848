#pragma once
#include <string>

/// What the bits of a reference depend on at run time: the versions of Embree and of the C library, and the processor's
/// instruction set, by which both choose their code.
std::string render_platform();
