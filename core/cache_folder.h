#pragma once
#include <filesystem>

/// Of references, of scenes made by number and of shaders compiled for chips: SSRLAB_CACHE, else $XDG_CACHE_HOME/ssrlab, else ~/.cache/ssrlab.
std::filesystem::path default_cache_folder();
