#pragma once
#include <filesystem>
#include <string>

/// The path of the image `name` of a cell's or manifest's entry. Checked by path_inside(), and must lie below images/,
/// so that no entry reaches cells and tables.
std::filesystem::path image_path(const std::filesystem::path& results, const std::string& name,
                                 const std::string& where = "");

/// The hash of a file's bytes; "" if it cannot be read.
std::string file_hash(const std::filesystem::path& file);
