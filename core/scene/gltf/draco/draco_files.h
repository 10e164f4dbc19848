#pragma once
#include <cstdint>
#include <istream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

// The protocol between ssrlab and draco_decoder (main.cpp), both on one machine: the size of JSON (uint64), JSON,
// bytes.

/// The result of one mesh. A `problem` says why it could not be decoded, an `error` why to refuse the file.
struct DracoResult {
    std::string problem = {}, error = {};
    uint64_t point_count = 0;
    std::string indices = {};                  ///< three uint32 per triangle
    std::vector<std::string> attributes = {};  ///< in the order in which they were asked for
};

inline void write_json(std::ostream& out, const nlohmann::json& value) {
    const std::string text = value.dump();
    const uint64_t size = text.size();
    out.write(reinterpret_cast<const char*>(&size), sizeof size) << text;
}

/// `size` bytes; empty at the end of the stream.
inline std::string read_bytes(std::istream& in, uint64_t size) {
    std::string bytes(size, '\0');
    if (!in.read(bytes.data(), std::streamsize(size))) bytes.clear();
    return bytes;
}

/// A JSON value; discarded at the end of the stream.
inline nlohmann::json read_json_value(std::istream& in) {
    uint64_t size = 0;
    in.read(reinterpret_cast<char*>(&size), sizeof size);
    return nlohmann::json::parse(in ? read_bytes(in, size) : "", nullptr, false);
}

/// The list of jobs: `size` of the data, `what` for messages, and per attribute `id`, `component_type` and `components`
/// (glTF's), and `what`. The data of all jobs follow, one after the other.
inline nlohmann::json read_draco_jobs(std::istream& in) { return read_json_value(in); }

/// Tells ssrlab that the decoder runs.
inline void write_draco_start(std::ostream& out) { out.put('D').flush(); }

inline void write_draco_result(std::ostream& out, const DracoResult& result) {
    nlohmann::json sizes = nlohmann::json::array();
    for (const std::string& attribute : result.attributes) sizes.push_back(attribute.size());
    write_json(out, {{"problem", result.problem},
                     {"error", result.error},
                     {"point_count", result.point_count},
                     {"indices", result.indices.size()},
                     {"attributes", sizes}});
    out << result.indices;
    for (const std::string& attribute : result.attributes) out << attribute;
    out.flush();
}

/// False at the end of the stream, or if the decoder ended within the result. `set_aside` gets the number of bytes
/// before they are read.
template <class SetAside>
bool read_draco_result(std::istream& in, DracoResult& result, const SetAside& set_aside) {
    const nlohmann::json header = read_json_value(in);
    if (header.is_discarded()) return false;
    result = {.problem = header.at("problem"), .error = header.at("error"), .point_count = header.at("point_count")};
    uint64_t bytes = header.at("indices").get<uint64_t>();
    for (const nlohmann::json& size : header.at("attributes")) bytes += size.get<uint64_t>();
    set_aside(double(bytes));
    result.indices = read_bytes(in, header.at("indices"));
    for (const nlohmann::json& size : header.at("attributes")) result.attributes.push_back(read_bytes(in, size));
    return bool(in);
}
