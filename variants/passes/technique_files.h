#pragma once
#include "variants/passes/declaration.h"

/// Reads what the technique's passes name: shaders of its folder, or of ssrlab by their paths under variants/, and what
/// these include. DeclaredForm::shader and DeclaredPass::stage then are as a pass_list wants them. Adds to `files` and
/// `sources` of `read`, whose path is the folder. Fails with Error, which names file and line, on what is missing,
/// includes itself or lies elsewhere.
void read_shaders(Declaration& declaration, TechniqueFolder& read);
