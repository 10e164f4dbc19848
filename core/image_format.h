#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

/// The formats of images that ssrlab reads.
enum class ImageFormat { none, exr, png, jpeg, webp, radiance };

/// The format of a file by its first bytes; its name does not count. `bytes`: all of the file, or its first 512.
ImageFormat image_format(std::span<const uint8_t> bytes);

/// What an image is for: texels and codes (as in PNG), linear radiance (as in OpenEXR), or a comparison, which takes
/// either.
enum class ImageUse { codes, radiance, comparison };

/// Why bytes are no image for `use`, as the words after "FILE ": "is a TIFF; convert the file: oiiotool a.tif -o
/// a.exr", "is an HTML page, ...". `file`: its name, for the command. Empty if the format is unknown.
std::string why_unreadable(std::span<const uint8_t> bytes, const std::string& file, ImageUse use);

/// The first bytes of a file, at most 512; empty if it cannot be read.
std::vector<uint8_t> first_bytes(const std::filesystem::path& file);

/// A name for a shell command: in quotes unless it is plain.
std::string quoted_for_shell(const std::string& name);
