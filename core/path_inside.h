#pragma once
#include <filesystem>
#include <string>

/// The path below `folder` of the `name` in a file. All such names become paths by this function only, and so do fixed
/// names if the folder may come from a stranger. Fails with Error unless `name` is relative, has no "..", and passes no
/// symbolic link below `folder`; parts may be missing. `folder` itself, which the user named, may be a link. `where`:
/// file and key that hold the name, for the message. Processes that write into the folder meanwhile are trusted.
std::filesystem::path path_inside(const std::filesystem::path& folder, const std::string& name,
                                  const std::string& where = "");
