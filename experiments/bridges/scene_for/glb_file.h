#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

/// Builds a binary glTF 2.0: its JSON, and the one buffer that the JSON refers to.
class GlbFile {
public:
    nlohmann::json json = {{"asset", {{"version", "2.0"}, {"generator", "ssrlab"}}}};

    /// Adds tightly packed elements of `components` floats; returns the accessor's index. `has_bounds` also states
    /// least and largest values, which glTF requires for positions (section 3.6.2.5).
    size_t add_floats(std::span<const float> values, unsigned components, bool has_bounds = false);
    size_t add_indices(std::span<const uint32_t> indices);  ///< indices of triangles; returns the accessor's index
    size_t add_bytes(std::span<const std::byte> bytes);     ///< returns the view's index

    /// Adds an element to an array of the document; returns its index.
    size_t add(const char* array, nlohmann::json element);
    void uses_extension(const char* name);

    /// Writes the file. Fails with Error if it exceeds the 4 GiB that its header can state, with MachineError if it
    /// cannot be written.
    void write(const std::filesystem::path& file);

private:
    std::vector<std::byte> buffer_;
};
