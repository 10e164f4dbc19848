// draco_decoder IN OUT MEMORY: decodes meshes that the library Draco has compressed.
//
// A program of its own, since damaged data may end the process in Debian's Draco 1.5.5. IN and OUT are described in
// core/scene/gltf/draco/draco_files.h; OUT gets each result as soon as it is known. MEMORY: bytes that may be taken.
#include "core/error.h"
#include "core/reading_limits.h"
#include "core/scene/gltf/draco/draco_files.h"
#include "core/scene/gltf/draco/draco_mesh.h"

#include <sys/resource.h>
#include <exception>
#include <fstream>
#include <iostream>
#include <new>

namespace {
using nlohmann::json;

/// The library's own requests for memory end here if they pass what its data announced.
void limit_memory(uint64_t bytes) {
    const rlimit no_dump{0, 0};
    setrlimit(RLIMIT_CORE, &no_dump);
#ifndef __SANITIZE_ADDRESS__  // which maps terabytes
    constexpr uint64_t program_itself = 512'000'000;
    const rlimit most{bytes + program_itself, bytes + program_itself};
    setrlimit(RLIMIT_AS, &most);
#endif
}

/// `written`: what all results take.
DracoResult decode(const json& job, const std::string& data, MemoryShare& written) {
    DracoResult result;
    try {
        const std::string what = job.at("what").get<std::string>();
        const auto mesh =
            DracoMesh::decode({reinterpret_cast<const uint8_t*>(data.data()), data.size()}, what, result.problem);
        if (!mesh) return result;
        written.add(12.0 * double(mesh->triangle_count()), what);
        result.point_count = mesh->point_count();
        result.indices = mesh->indices();
        for (const json& a : job.at("attributes")) {
            const auto components = a.at("components").get<unsigned>();
            written.add(4.0 * double(mesh->point_count()) * components, what);
            result.attributes.push_back(
                mesh->attribute(a.at("id"), a.at("component_type"), components, a.at("what").get<std::string>()));
        }
    } catch (const std::bad_alloc&) {
        result = {.problem = "its Draco data take more memory than they announce"};
    } catch (const Error& e) {
        result = {.error = e.what()};
    }
    return result;
}
}  // namespace

int main(int argc, char** argv) try {
    if (argc != 4) throw std::runtime_error("usage: draco_decoder IN OUT MEMORY");
    reading_limits().memory = std::stoull(argv[3]);
    limit_memory(reading_limits().memory);
    std::ifstream in(argv[1], std::ios::binary);
    std::ofstream out(argv[2], std::ios::binary);
    write_draco_start(out);
    MemoryShare written;
    for (const json& job : read_draco_jobs(in))
        write_draco_result(out, decode(job, read_bytes(in, job.at("size")), written));
    return 0;
} catch (const std::exception& e) {
    std::cerr << "draco_decoder: " << e.what() << '\n';
    return 1;
}
