#pragma once
#include <filesystem>

/// Of references and of scenes made by number: SSRLAB_CACHE, else $XDG_CACHE_HOME/ssrlab, else ~/.cache/ssrlab.
std::filesystem::path default_cache_folder();
