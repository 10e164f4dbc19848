#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

/// The formats of images that ssrlab reads.
enum class ImageFormat { none, exr, png, jpeg, webp, radiance };

/// That of a file by its first bytes, whatever its name ends with. `bytes`: the file's, or its first 512.
ImageFormat image_format(std::span<const uint8_t> bytes);

/// What an image is for: texels and codes (PNG keeps them), linear radiance (OpenEXR keeps it), or whichever of both it
/// holds, to be compared.
enum class ImageUse { codes, radiance, comparison };

/// Why bytes are no image for `use`, as what follows "FILE ": "is a TIFF; convert the file: oiiotool a.tif -o a.exr",
/// "is an HTML page, ...". `file`: its name, for the command. Empty of bytes that are of no known format.
std::string why_unreadable(std::span<const uint8_t> bytes, const std::string& file, ImageUse use);

/// The first bytes of a file, at most 512; empty if it cannot be read.
std::vector<uint8_t> first_bytes(const std::filesystem::path& file);

/// A name as a command of a shell has it: in quotes where it is no plain one.
std::string quoted_for_shell(const std::string& name);
