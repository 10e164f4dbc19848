#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

/// A binary glTF 2.0 that is being made: its JSON, and the one buffer that all of it refers to.
class GlbFile {
public:
    nlohmann::json json = {{"asset", {{"version", "2.0"}, {"generator", "ssrlab"}}}};

    /// Tightly packed elements of `components` floats; returns the accessor's index. `has_bounds` also states their
    /// least and largest values, which glTF asks of positions (section 3.6.2.5).
    size_t add_floats(std::span<const float> values, unsigned components, bool has_bounds = false);
    size_t add_indices(std::span<const uint32_t> indices);  ///< of triangles; returns the accessor's index
    size_t add_bytes(std::span<const std::byte> bytes);     ///< returns the view's index

    /// Adds to an array of the document; returns the element's index.
    size_t add(const char* array, nlohmann::json element);
    void uses_extension(const char* name);

    /// Fails with Error if it is longer than the 4 GiB that its header can state, with MachineError if it cannot be
    /// written.
    void write(const std::filesystem::path& file);

private:
    std::vector<std::byte> buffer_;
};
