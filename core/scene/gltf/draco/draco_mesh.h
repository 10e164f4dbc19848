#pragma once
#include "core/reading_limits.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace draco {
class Mesh;
}

/// A mesh that the library Draco has decoded (bitstream 2.2, as KHR_draco_mesh_compression has it).
class DracoMesh {
public:
    /// None if the bytes are damaged or no mesh; `problem` then says so. Sets aside the memory that the bytes announce,
    /// and fails with Error, which begins with `what`, if that is too much.
    static std::unique_ptr<DracoMesh> decode(std::span<const uint8_t> bytes, const std::string& what,
                                             std::string& problem);
    ~DracoMesh();

    size_t point_count() const;
    size_t triangle_count() const;
    /// Three per triangle, as uint32.
    std::string indices() const;
    /// The values of an attribute, for each point `components` of a component type of glTF, packed. Fails with Error if
    /// the mesh has no attribute of that unique id, or if it has another number of components.
    std::string attribute(uint32_t id, int component_type, unsigned components, const std::string& what) const;

private:
    explicit DracoMesh(std::unique_ptr<draco::Mesh> mesh);

    std::unique_ptr<draco::Mesh> mesh_;
    MemoryShare memory_;
};
