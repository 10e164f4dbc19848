#include "core/scene/gltf/gltf_draco.h"

#include "core/child_process.h"
#include "core/error.h"
#include "core/memory_file.h"
#include "core/near_miss.h"
#include "core/own_files.h"
#include "core/scene/gltf/draco/draco_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace {
using nlohmann::json;

const json::json_pointer extension_place("/extensions/KHR_draco_mesh_compression");

const json& list_in(const json& root, const char* key) {
    static const json none = json::array();
    return root.contains(key) ? root[key] : none;
}

/// A primitive whose data are compressed.
struct Job {
    size_t mesh, primitive;
    std::string what;
    std::span<const uint8_t> data;
    std::vector<std::string> names = {};  ///< of the attributes
    json request = {};                    ///< as draco_decoder takes it
};

const json& primitive_in(const json& root, const Job& job) {
    return root["meshes"][job.mesh]["primitives"][job.primitive];
}

/// The accessor that the primitive names for an attribute, or for its indices.
const json& accessor_of(const json& root, const json& index, const std::string& what) {
    const json& accessors = list_in(root, "accessors");
    const auto number = index.get<size_t>();
    if (number >= accessors.size()) fail(what, ": accessor ", number, " does not exist; there are ", accessors.size());
    return accessors[number];
}

unsigned components_of(const std::string& type) {
    if (type.starts_with("VEC")) return unsigned(type.back() - '0');
    if (type.starts_with("MAT")) return unsigned((type.back() - '0') * (type.back() - '0'));
    return 1;
}

std::span<const uint8_t> bytes_of_view(const json& root, const GltfFile& file, const json& index,
                                       const std::string& what) {
    const json& views = list_in(root, "bufferViews");
    const auto view = index.get<size_t>();
    if (view >= views.size()) fail(what, ": buffer view ", view, " does not exist; there are ", views.size());
    return file.buffers[views[view]["buffer"].get<size_t>()].subspan(views[view].value("byteOffset", size_t(0)),
                                                                     views[view]["byteLength"].get<size_t>());
}

Job job_of(const json& root, const GltfFile& file, size_t mesh, size_t primitive) {
    Job job{mesh,
            primitive,
            file.name() + ": mesh " + std::to_string(mesh) + " primitive " + std::to_string(primitive) +
                ": KHR_draco_mesh_compression",
            {}};
    const json& source = primitive_in(root, job);
    const json& extension = source[extension_place];
    job.data = bytes_of_view(root, file, extension["bufferView"], job.what);
    job.request = {{"size", job.data.size()}, {"what", job.what}, {"attributes", json::array()}};
    for (const auto& [name, id] : extension["attributes"].items()) {
        if (!source["attributes"].contains(name)) continue;
        const std::string what = job.what + ", " + shortened(name);
        const json& accessor = accessor_of(root, source["attributes"][name], what);
        job.names.push_back(name);
        job.request["attributes"].push_back({{"id", id},
                                             {"component_type", accessor["componentType"]},
                                             {"components", components_of(accessor["type"].get<std::string>())},
                                             {"what", what}});
    }
    return job;
}

std::vector<Job> jobs_of(const json& root, const GltfFile& file) {
    std::vector<Job> jobs;
    const json& meshes = list_in(root, "meshes");
    for (size_t mesh = 0; mesh < meshes.size(); ++mesh)
        for (size_t i = 0; i < meshes[mesh]["primitives"].size(); ++i)
            if (meshes[mesh]["primitives"][i].contains(extension_place)) jobs.push_back(job_of(root, file, mesh, i));
    return jobs;
}

/// Lets draco_decoder decode the jobs, and returns the results of the first of them: all, unless it ended before.
std::vector<DracoResult> ask_decoder(std::span<const Job> jobs, MemoryShare& memory) {
    const MemoryFile in, out;
    {
        std::ofstream to(in.path(), std::ios::binary);
        json requests = json::array();
        for (const Job& job : jobs) requests.push_back(job.request);
        write_json(to, requests);
        for (const Job& job : jobs)
            to.write(reinterpret_cast<const char*>(job.data.data()), std::streamsize(job.data.size()));
    }
    // Without a new result; a mesh of a million triangles takes a second.
    const Patience patience{std::chrono::seconds(120), [&] { return size_t(std::filesystem::file_size(out.path())); }};
    try {
        run_program({(built_files() / "draco_decoder").string(), in.path(), out.path(), std::to_string(memory_left())},
                    &patience);
    } catch (const MachineError&) {  // ended by a signal, or by us
        if (patience.progress() == 0) throw;
    }
    std::ifstream from(out.path(), std::ios::binary);
    from.get();
    std::vector<DracoResult> results;
    for (DracoResult result; results.size() < jobs.size() && read_draco_result(from, result, [&](double bytes) {
                                 memory.add(bytes, jobs[results.size()].what + ": what it holds");
                             });)
        results.push_back(std::move(result));
    return results;
}

std::vector<DracoResult> decode_all(const std::vector<Job>& jobs, MemoryShare& memory) {
    std::vector<DracoResult> results;
    while (results.size() < jobs.size()) {
        std::vector<DracoResult> next = ask_decoder(std::span(jobs).subspan(results.size()), memory);
        std::ranges::move(next, std::back_inserter(results));
        if (results.size() < jobs.size()) results.push_back({.problem = "its Draco data are damaged"});
    }
    return results;
}

/// Adds an accessor whose elements are `bytes`, packed; otherwise as `like`. Returns its index.
size_t add_accessor(json& root, GltfFile& file, json like, std::string bytes, size_t count) {
    root["bufferViews"].push_back({{"buffer", file.buffers.size()}, {"byteLength", bytes.size()}});
    file.add_buffer(std::move(bytes));
    like["bufferView"] = root["bufferViews"].size() - 1;
    like["count"] = count;
    like.erase("byteOffset"), like.erase("sparse");
    root["accessors"].push_back(std::move(like));
    return root["accessors"].size() - 1;
}

void put_into(json& root, GltfFile& file, const Job& job, DracoResult result) {
    json primitive = primitive_in(root, job);
    for (size_t i = 0; i < job.names.size(); ++i) {
        json& index = primitive["attributes"][job.names[i]];
        const json like = accessor_of(root, index, job.what);
        index = add_accessor(root, file, like, std::move(result.attributes[i]), result.point_count);
    }
    const size_t index_count = result.indices.size() / sizeof(uint32_t);
    primitive["indices"] =
        add_accessor(root, file, {{"componentType", TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT}, {"type", "SCALAR"}},
                     std::move(result.indices), index_count);
    primitive["mode"] = TINYGLTF_MODE_TRIANGLES;
    root["meshes"][job.mesh]["primitives"][job.primitive] = std::move(primitive);
}

/// Whether the primitive can be drawn without the extension.
bool has_fallback(const json& root, const Job& job) {
    const json& primitive = primitive_in(root, job);
    const auto has_data = [&](const json& index) { return accessor_of(root, index, job.what).contains("bufferView"); };
    if (primitive.contains("indices") && !has_data(primitive["indices"])) return false;
    const json& attributes = primitive["attributes"];
    return attributes.contains("POSITION") && std::ranges::all_of(attributes, has_data);
}
}  // namespace

void decode_draco(json& root, GltfFile& file) {
    const std::vector<Job> jobs = jobs_of(root, file);
    std::vector<DracoResult> results = decode_all(jobs, file.memory);
    for (size_t i = 0; i < jobs.size(); ++i) {
        const Job& job = jobs[i];
        if (!results[i].error.empty()) throw Error(results[i].error);
        if (results[i].problem.empty()) {
            put_into(root, file, job, std::move(results[i]));
        } else if (has_fallback(root, job)) {
            file.warn("The KHR_draco_mesh_compression of mesh " + std::to_string(job.mesh) + " primitive " +
                      std::to_string(job.primitive) + " cannot be decoded; the file's fallback is shown.");
        } else {
            fail(job.what, ": ", results[i].problem,
                 "; `gltf-transform copy IN.glb OUT.glb` writes a file that does without the extension");
        }
    }
}
