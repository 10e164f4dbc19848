#include "core/scene/gltf/draco/draco_mesh.h"

#include "core/error.h"

#include <tiny_gltf.h>
#include <algorithm>
#include <cstring>
#include <exception>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#include <draco/compression/config/compression_shared.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#pragma GCC diagnostic pop

namespace {

/// What a mesh's connectivity announces before it is decoded.
struct Announced {
    uint32_t faces = 0, vertices = 0;
    uint8_t attribute_seams = 0;  ///< attributes with a connectivity of their own
};

/// Draco's decoder, which asks for memory before it takes any. Draco is built to return false where something is wrong,
/// and not for exceptions to pass through: they wait in `refused`.
template <class Base>
class CarefulDecoder final : public Base {
public:
    CarefulDecoder(MemoryShare& memory, const std::string& what) : memory_(memory), what_(what) {}

    std::exception_ptr refused;

private:
    bool DecodeConnectivity() override {
        draco::DecoderBuffer ahead = *this->buffer();
        Announced announced;
        if (!draco::DecodeVarint(is_edgebreaker ? &announced.vertices : &announced.faces, &ahead) ||
            !draco::DecodeVarint(is_edgebreaker ? &announced.faces : &announced.vertices, &ahead) ||
            (is_edgebreaker && !ahead.Decode(&announced.attribute_seams)))
            return false;
        // Tables of corners: the mesh's and one for each seam, each with maps from vertices to corners and back.
        constexpr double per_face = 64, per_vertex = 32;
        return set_aside(announced.faces * per_face * (1 + announced.attribute_seams) + announced.vertices * per_vertex,
                         announced.faces, announced.vertices) &&
               Base::DecodeConnectivity();
    }

    bool DecodeAllAttributes() override {
        const draco::PointCloud& points = *this->point_cloud();
        double per_point = 0;
        for (int i = 0; i < points.num_attributes(); ++i) {
            const draco::PointAttribute& attribute = *points.attribute(i);
            // The values, their codes and residuals as integers, and the maps of points to values.
            constexpr double per_component = 12, maps = 16;
            per_point += double(attribute.byte_stride()) + per_component * attribute.num_components() + maps;
        }
        return set_aside(double(points.num_points()) * per_point, this->mesh()->num_faces(), points.num_points()) &&
               Base::DecodeAllAttributes();
    }

    bool set_aside(double bytes, uint32_t faces, uint32_t points) {
        try {
            memory_.add(bytes, what_ + " of " + std::to_string(faces) + " triangles and " + std::to_string(points) +
                                   " vertices");
            return true;
        } catch (const Error&) {
            refused = std::current_exception();
            return false;
        }
    }

    static constexpr bool is_edgebreaker = std::is_same_v<Base, draco::MeshEdgebreakerDecoder>;
    MemoryShare& memory_;
    const std::string& what_;
};

/// Empty if the mesh was decoded, else what is wrong.
template <class Base>
std::string decode_with(draco::DecoderBuffer& buffer, draco::Mesh& mesh, MemoryShare& memory, const std::string& what) {
    CarefulDecoder<Base> decoder(memory, what);
    draco::DecoderOptions options;
    const draco::Status status = decoder.Decode(options, &buffer, &mesh);
    if (decoder.refused) std::rethrow_exception(decoder.refused);
    return status.ok() ? "" : "its Draco data are damaged";
}

/// Why the bytes are not such as the extension allows; empty if they are.
std::string problem_of(const draco::DracoHeader& header) {
    if (std::memcmp(header.draco_string, "DRACO", 5) != 0) return "its buffer view holds no Draco data";
    if (header.version_major != 2 || header.version_minor != 2)
        return "its Draco data are of version " + std::to_string(header.version_major) + "." +
               std::to_string(header.version_minor) + ", but the extension has 2.2";
    if (header.encoder_type != draco::TRIANGULAR_MESH) return "its Draco data are no mesh of triangles";
    if (header.flags & METADATA_FLAG_MASK) return "its Draco data hold metadata, which ssrlab does not read";
    return "";
}

bool has_indices_in_range(const draco::Mesh& mesh) {
    for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i)
        for (int k = 0; k < 3; ++k)
            if (mesh.face(i)[size_t(k)].value() >= mesh.num_points()) return false;
    return true;
}

template <class T>
std::string values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute, const std::string& what) {
    const auto components = size_t(attribute.num_components());
    std::string bytes(mesh.num_points() * components * sizeof(T), '\0');
    std::vector<T> value(components);
    for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
        const draco::AttributeValueIndex at = attribute.mapped_index(i);
        if (at.value() >= attribute.size() || !attribute.ConvertValue<T>(at, value.data()))
            fail(what, ": point ", i.value(), " has no value that accessor's component type could hold");
        std::memcpy(&bytes[i.value() * components * sizeof(T)], value.data(), components * sizeof(T));
    }
    return bytes;
}
}  // namespace

DracoMesh::DracoMesh(std::unique_ptr<draco::Mesh> mesh) : mesh_(std::move(mesh)) {}
DracoMesh::~DracoMesh() = default;

std::unique_ptr<DracoMesh> DracoMesh::decode(std::span<const uint8_t> bytes, const std::string& what,
                                             std::string& problem) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::DecoderBuffer ahead = buffer;
    draco::DracoHeader header{};
    problem = "its buffer view holds no Draco data";
    if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok()) return nullptr;
    problem = problem_of(header);
    if (!problem.empty()) return nullptr;
    std::unique_ptr<DracoMesh> decoded(new DracoMesh(std::make_unique<draco::Mesh>()));
    const bool is_edgebreaker = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
    problem = is_edgebreaker
                  ? decode_with<draco::MeshEdgebreakerDecoder>(buffer, *decoded->mesh_, decoded->memory_, what)
                  : decode_with<draco::MeshSequentialDecoder>(buffer, *decoded->mesh_, decoded->memory_, what);
    if (problem.empty() && !has_indices_in_range(*decoded->mesh_)) problem = "its Draco data are damaged";
    return problem.empty() ? std::move(decoded) : nullptr;
}

size_t DracoMesh::point_count() const { return mesh_->num_points(); }

size_t DracoMesh::triangle_count() const { return mesh_->num_faces(); }

std::string DracoMesh::indices() const {
    std::string bytes(size_t(mesh_->num_faces()) * 3 * sizeof(uint32_t), '\0');
    for (draco::FaceIndex i(0); i < mesh_->num_faces(); ++i)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t index = mesh_->face(i)[k].value();
            std::memcpy(&bytes[(i.value() * 3 + k) * sizeof(uint32_t)], &index, sizeof(uint32_t));
        }
    return bytes;
}

std::string DracoMesh::attribute(uint32_t id, int component_type, unsigned components, const std::string& what) const {
    const draco::PointAttribute* attribute = mesh_->GetAttributeByUniqueId(id);
    if (!attribute) fail(what, ": its Draco data have no attribute with the id ", id);
    if (unsigned(attribute->num_components()) != components)
        fail(what, ": has ", components, " components, but ", int(attribute->num_components()), " in its Draco data");
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return values_of<int8_t>(*mesh_, *attribute, what);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return values_of<uint8_t>(*mesh_, *attribute, what);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return values_of<int16_t>(*mesh_, *attribute, what);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return values_of<uint16_t>(*mesh_, *attribute, what);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return values_of<uint32_t>(*mesh_, *attribute, what);
        default:
            return values_of<float>(*mesh_, *attribute, what);
    }
}
