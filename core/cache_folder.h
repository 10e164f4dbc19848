#pragma once
#include <filesystem>

/// The folder of cached references, generated scenes and compiled shaders: $SSRLAB_CACHE, else $XDG_CACHE_HOME/ssrlab,
/// else ~/.cache/ssrlab.
std::filesystem::path default_cache_folder();
