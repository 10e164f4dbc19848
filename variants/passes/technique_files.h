#pragma once
#include "variants/passes/declaration.h"

/// Reads the shaders that the technique's passes name, and their includes: files of its folder, or of ssrlab by their
/// paths under variants/. Sets DeclaredForm::shader and DeclaredPass::stage for a pass_list. Adds to `files` and
/// `sources` of `read`, whose path is the folder. Fails with Error, which names file and line, if a file is missing,
/// includes itself or lies elsewhere.
void read_shaders(Declaration& declaration, TechniqueFolder& read);
