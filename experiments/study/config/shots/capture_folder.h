#pragma once
#include <filesystem>
#include <map>

/// The folders of a capture's frames by number: `folder` as frame 0 if it holds a gbuffer.exr, else its folders
/// frame_<number>. Reads no pixels. Fails with Error if there is no frame, or if both kinds exist.
std::map<unsigned, std::filesystem::path> capture_frames(const std::filesystem::path& folder);
