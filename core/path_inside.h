#pragma once
#include <filesystem>
#include <string>

/// The path below `folder` of what a file calls `name`: the one way in which such a name becomes a path, also of a
/// fixed name where the folder may come from a stranger. Fails with Error unless it is relative, has no "..", and
/// nothing on the way from `folder` is a symbolic link; what does not exist yet is none. `folder` itself, which the
/// user named, may be one. `where`: file and key that have the name, for the message. Whoever writes into the folder at
/// the same time is trusted.
std::filesystem::path path_inside(const std::filesystem::path& folder, const std::string& name,
                                  const std::string& where = "");
