#pragma once
#include "experiments/cli/command_line.h"

/// What the program declares of itself, of which `experiments/python reference_pages` writes
/// experiments/docs/reference: commands, keys of configs, columns of results, techniques, tracers, denoisers, metrics,
/// families of scenes, images that shaders read, and layers of files.
nlohmann::json declarations(const CLI::App& app);
