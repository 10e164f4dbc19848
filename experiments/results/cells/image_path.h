#pragma once
#include <filesystem>
#include <string>

/// The path of an image that an entry of a cell or a manifest calls `name`: as path_inside(), and below images/, so
/// that no entry reaches cells and tables.
std::filesystem::path image_path(const std::filesystem::path& results, const std::string& name,
                                 const std::string& where = "");

/// The hash of a file's bytes; "" if it cannot be read.
std::string file_hash(const std::filesystem::path& file);
