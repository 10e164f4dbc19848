#pragma once
#include <filesystem>
#include <map>

/// The folders of a capture's frames by their numbers: `folder` itself as frame 0, if it holds a gbuffer.exr, else its
/// folders frame_<number>. Reads no pixels. Fails with Error if there are none, or both kinds.
std::map<unsigned, std::filesystem::path> capture_frames(const std::filesystem::path& folder);
