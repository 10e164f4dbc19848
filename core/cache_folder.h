#pragma once
#include <filesystem>

/// Of references, scenes made by number and compiled shaders: SSRLAB_CACHE, else $XDG_CACHE_HOME/ssrlab, else
/// ~/.cache/ssrlab.
std::filesystem::path default_cache_folder();
