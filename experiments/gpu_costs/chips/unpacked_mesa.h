#pragma once
#include <filesystem>

// A Mesa that is unpacked into a folder and not installed: its driver radv may know newer chips than the installed one.
// experiments/newer_mesa.sh makes such a folder.

/// The folder that the environment variable SSRLAB_MESA names; "": the installed Mesa.
std::filesystem::path chosen_mesa();

/// The file of radv in the folder `mesa`, in usr/lib or a folder of it, as packages have it; "" if `mesa` is "". Fails
/// with Error if there is none.
std::filesystem::path radv_in(const std::filesystem::path& mesa);
