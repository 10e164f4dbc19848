#pragma once
#include <filesystem>

// Where ssrlab's own files lie. A program in PREFIX/bin is an installed one if there is PREFIX/share/ssrlab. Any other
// program uses the checkout and the build folder that it was compiled in. Nothing that runs for a user writes there.

/// The folder of scenes, shaders, scripts, pages, configs and documents, at their paths in the repository:
/// PREFIX/share/ssrlab, or the checkout.
const std::filesystem::path& own_files();

/// The folder of what the build makes for the program, at its paths in the build folder: the programs that ssrlab
/// starts, the compiler of shaders that it loads, build_commit.json, and the scripts and styles of pages.
/// PREFIX/lib/ssrlab, or the build folder.
const std::filesystem::path& built_files();
